// Checks whether a parameter accepts a value: the loader checks constants, a run checks entries.
#pragma once

#include <optional>
#include <string>

#include "core/node_type.h"

namespace lockstep {

// The error in `value`, which has the parameter's type: outside of its range, or not among its
// choices. The message does not mention where the value comes from.
std::optional<RuleBreak> refuse_value(const Parameter& parameter, const Value& value);

// The same as a text, with the value of the entry that a run has read: what, parameter, value,
// entry, hint.
std::string refusal_text(const RuleBreak& why, std::string_view parameter, const Value& value,
                         std::string_view entry);

// "from 0 to 1", "more than 0, at most 1", …; "" when every number is allowed.
std::string range_text(const Range& range);

}  // namespace lockstep
