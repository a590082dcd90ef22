// A value of an entry in one piece: lockstep_entry_value.
#pragma once

#include <vector>

#include "base/blackboard/entry.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// All but the count of writes. `texts` are those of a list; it points into the entry else.
lockstep_entry_value described(const Entry& entry, std::vector<lockstep_text>& texts);
// Makes the entry if it is not present. False: it holds values of another type only.
bool assign(Entry& entry, const lockstep_entry_value& value);

}  // namespace lockstep::host
