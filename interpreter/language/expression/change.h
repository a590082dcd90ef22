// A script that only changes the number of an entry by a constant, as 'n = n + 1' and 'n -= 0.5':
// most of those that assign do no more.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "base/blackboard/entry.h"
#include "language/expression/program.h"
#include "language/expression/relation.h"

namespace lockstep::host {

inline double calculated(double left, Operation operation, double right) {
  switch (operation) {
    case Operation::Add:
    case Operation::AddTo:
      return left + right;
    case Operation::Subtract:
    case Operation::SubtractFrom:
      return left - right;
    case Operation::Multiply:
    case Operation::MultiplyBy:
      return left * right;
    default:
      return left / right;
  }
}

struct Change {
  Operation operation;
  double by;
  std::optional<std::int64_t> step;  // a whole number is changed by adding this
};

// The change that the code makes in its first entry, if it does no more.
std::optional<Change> only_change(const std::vector<Instruction>& code);

// False: nothing has happened, and the whole program says what does.
inline bool apply(const Change& change, Entry& entry) {
  if (const auto* const whole = std::get_if<std::int64_t>(&entry.value())) {
    if (change.step) {
      const auto is_exact = [](std::int64_t it) {
        return it <= kLargestExact && it >= -kLargestExact;
      };
      if (!is_exact(*whole) || !is_exact(*whole + *change.step)) return false;
      entry.assign_same(*whole + *change.step);
      return true;
    }
    double number = 0;
    if (!take_exactly(*whole, number)) return false;
    const double result = calculated(number, change.operation, change.by);
    if (!(std::fabs(result) <= static_cast<double>(kLargestExact))) return false;
    const auto exact = static_cast<std::int64_t>(result);
    if (static_cast<double>(exact) != result) return false;
    entry.assign_same(exact);
  } else {
    const auto* const real = std::get_if<double>(&entry.value());
    if (real == nullptr) return false;
    const double result = calculated(*real, change.operation, change.by);
    if (!std::isfinite(result)) return false;
    entry.assign_same(result);
  }
  return true;
}

}  // namespace lockstep::host
