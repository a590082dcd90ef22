// A compiled tree from a short text, without documents:
//   Sequence(a Inverter(b))   Parallel[success_count=1](a b)   ParallelAbsolute[barriers=.5;1](a b)
// A name with a capital is a built-in kind, or a node of a known plugin. Any other is a scripted
// action, with '?' behind it a scripted condition, with [bare] an action that has no function but
// tick. Wait[seconds={pause}] takes its parameter from the entry 'pause'. a[skip_if=n>1] has a
// script; for BehaviorTree.CPP it is a[_skipIf=n>1]. a[out={n} flag={b}] has outputs.
#pragma once

#include <string_view>

#include "engine/tree.h"

namespace lockstep::host::test {

// Throws std::invalid_argument for a text that is not a tree, and for parameters that break the
// kind's rule or arity.
Tree tree_from_text(std::string_view text, const LanguageRules& rules = kLockstepRules);

}  // namespace lockstep::host::test
