// Relations of numbers where numbers that are close to each other are equal.
#pragma once

#include <cmath>

#include "language/expression/program.h"

namespace lockstep::host {

// False for NaN, but for NotEqual.
inline bool are_nearly(double left, Relation relation, double right, double within) {
  const bool equal = left == right || std::abs(left - right) <= within;
  switch (relation) {
    case Relation::Equal:
      return equal;
    case Relation::NotEqual:
      return !equal;
    case Relation::Less:
      return left < right && !equal;
    case Relation::LessEqual:
      return left < right || equal;
    case Relation::Greater:
      return left > right && !equal;
    case Relation::GreaterEqual:
      return left > right || equal;
  }
  return false;
}

}  // namespace lockstep::host
