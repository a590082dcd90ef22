// Types in messages.
#pragma once

#include <string>

#include "base/core/parameter_value.h"

namespace lockstep::host {

// "an int", "a list of double".
inline std::string with_article(ValueType type, const ObjectType* object) {
  const std::string_view name = type_name(type, object);
  return std::string(name.starts_with('i') ? "an " : "a ").append(name);
}

}  // namespace lockstep::host
