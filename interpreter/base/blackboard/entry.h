// An entry of a blackboard in a run: its value, and what it may hold.
#pragma once

#include <cstdint>

#include "base/core/value.h"

namespace lockstep::host {

enum class Typing : std::uint8_t {
  Strict,    // it holds values of its type only, and exists from the beginning to the end
  Declared,  // the first port that names it gives the type; a value of another kind may be in it
  Any        // nobody has declared a type: `type` has no meaning
};

struct Entry {
  Value value;               // NoValue: not written yet
  std::uint32_t writes = 0;  // how often it was written since it was made; it may wrap
  ValueType type = ValueType::String;
  Typing typing = Typing::Strict;
  bool is_present = true;              // false: there is no such entry now
  const ObjectType* object = nullptr;  // of type Object: which

  bool has_value() const { return !std::holds_alternative<NoValue>(value); }
};

// Makes an entry that is not present, without a value.
inline void make_entry(Entry& entry, Typing typing, ValueType type = ValueType::String,
                       const ObjectType* object = nullptr) {
  entry = {.value = {}, .type = type, .typing = typing, .object = object};
}

// Removes it: its value, its type and its count are gone.
inline void unset_entry(Entry& entry) {
  make_entry(entry, Typing::Any);
  entry.is_present = false;
}

// Writes the value of a port of that type, and counts it. An entry without a type gets this type.
// For an entry of another type the value is converted; if it cannot be, returns false, and the
// entry stays as it was.
bool write_entry(Entry& entry, ValueType type, const ObjectType* object, Value value);

}  // namespace lockstep::host
