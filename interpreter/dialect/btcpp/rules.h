// The language of BehaviorTree.CPP.
#pragma once

#include "base/core/language.h"

namespace lockstep::host::btcpp {

extern const LanguageRules kRules;

}  // namespace lockstep::host::btcpp
