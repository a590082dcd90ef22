// A value of an entry in one piece: lockstep_entry_value.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/blackboard/entry.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// All but the count of writes. `texts` are those of a list; it points into the entry else.
lockstep_entry_value described(const Entry& entry, std::vector<lockstep_text>& texts);
// Makes the entry if it is not present. False: it holds values of another type only.
bool assign(Entry& entry, const lockstep_entry_value& value);

// Why the entry `key` has not taken a value of this type, which may be of another kind of number.
std::string refusal_of(const Entry& entry, std::string_view key, ValueType type);

}  // namespace lockstep::host
