// When two values are equal in a script.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "base/core/value.h"

namespace lockstep::host {

inline constexpr double kEqualWithin = std::numeric_limits<float>::epsilon();

inline bool is_equal(double left, double right) {
  return std::abs(left - right) <= kEqualWithin;
}

// The result of `value == 'text'` in a script; false where that is an error.
bool equals_text(const Value& value, const std::string& text);

}  // namespace lockstep::host
