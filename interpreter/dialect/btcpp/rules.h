// The language of BehaviorTree.CPP.
#pragma once

#include "core/language.h"

namespace lockstep::host::btcpp {

extern const LanguageRules kRules;

}  // namespace lockstep::host::btcpp
