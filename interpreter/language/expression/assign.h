// The assignment of a script to an entry.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/blackboard/entry.h"
#include "language/expression/operand.h"
#include "language/expression/script_enums.h"

namespace lockstep::host {

// The number that a text means in a script: true, false, a word of `enums`, or the number that it
// begins with.
std::optional<double> number_in_script(std::string_view text, const ScriptEnums* enums);

// Stores `value` and counts the write. False: the entry does not take it, and is as it was. An
// entry that has a value keeps its kind.
bool assign(Entry& entry, const Operand& value, const ScriptEnums* enums);
// The same, where a number goes into an entry that has one of the same kind. False: it is not so.
bool assign_number(Entry& entry, const Operand& value);
// The error after that. `shown`: the value as messages show it. `name`: of the entry.
std::string refusal(const Entry& entry, const Operand& value, std::string_view shown,
                    std::string_view name);

}  // namespace lockstep::host
