// Entries that are written between ticks, by a person at the monitor or by a scenario.
#pragma once

#include "base/blackboard/entry.h"

namespace lockstep::host {

// `type`: of the text that `value` was read from. An entry without a declared type takes any value,
// and stays without a type. False: the entry cannot hold the value, and is unchanged.
inline bool set_entry(Entry& entry, ValueType type, const ObjectType* object, Value value) {
  if (!entry.is_present) make_entry(entry, Typing::Any);
  if (entry.typing != Typing::Any) return write_entry(entry, type, object, std::move(value));
  entry.assign(std::move(value));
  return true;
}

}  // namespace lockstep::host
