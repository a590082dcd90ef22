// The language of BehaviorTree.CPP.
#pragma once

#include "core/language.h"

namespace lockstep::btcpp {

extern const LanguageRules kRules;

}  // namespace lockstep::btcpp
