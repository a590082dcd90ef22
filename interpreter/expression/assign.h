// What an assignment in a script does to an entry.
#pragma once

#include <string>
#include <string_view>

#include "core/entry.h"
#include "expression/expression.h"
#include "expression/operand.h"

namespace lockstep {

// The number that a text means in a script: true, false, a word of `enums`, or the number that it
// begins with.
std::optional<double> number_in_script(std::string_view text, const ScriptEnums* enums);

// Stores `value` and counts the write. Returns "" or the error; the entry is then as it was. An
// entry that has a value keeps its kind. `name` is for messages.
std::string assign(Entry& entry, const Operand& value, const ScriptEnums* enums,
                   std::string_view name);

}  // namespace lockstep
