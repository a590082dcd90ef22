// The value of a text that comes from outside, also for an entry or a port without a type.
#pragma once

#include <optional>
#include <string>

#include "base/core/value.h"

namespace lockstep::host {

// A number or a truth value, if the text reads as one; "false" as a text would be no "no".
Value value_of_any_type(const std::string& text);

// The same where there may be a type. Nothing: the text is no value of it.
inline std::optional<Value> value_from_outside(bool is_any, ValueType type,
                                               const std::string& text) {
  return is_any ? value_of_any_type(text) : parse_value(type, text);
}

}  // namespace lockstep::host
