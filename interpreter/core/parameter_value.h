// Whether a value is one that a parameter takes: the loader asks it of constants, a run of entries.
#pragma once

#include <optional>
#include <string>

#include "core/node_type.h"

namespace lockstep {

// What is wrong with `value`, which has the parameter's type: its range or its choices. The message
// does not say where the value comes from.
std::optional<RuleBreak> refuse_value(const Parameter& parameter, const Value& value);

// "from 0 to 1", "more than 0, at most 1", …; "" when every number is allowed.
std::string range_text(const Range& range);

}  // namespace lockstep
