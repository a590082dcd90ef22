// The value of a text for an entry without a type.
#pragma once

#include <string>

#include "base/core/value.h"

namespace lockstep::host {

// A number or a truth value, if the text reads as one; "false" as a text would be no "no".
Value value_of_any_type(const std::string& text);

}  // namespace lockstep::host
