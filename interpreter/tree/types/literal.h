// The type that a start value has by itself.
#pragma once

#include <string_view>

#include "base/core/value.h"

namespace lockstep::host {

// As which type the value of an attribute of a SubTree begins: Int, Double or String.
ValueType literal_type(std::string_view text);

}  // namespace lockstep::host
