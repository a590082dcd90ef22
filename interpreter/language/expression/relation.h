// How scripts compare numbers.
#pragma once

#include <cstdint>

#include "base/blackboard/conversion.h"
#include "base/core/progress.h"
#include "base/core/value.h"
#include "language/expression/equal.h"
#include "language/expression/program.h"

namespace lockstep::host {

// Without branches: a bit for each relation.
inline bool is_true(Relation relation, unsigned not_above, unsigned not_below) {
  const unsigned equal = not_above & not_below;
  const auto bit = [](Relation of, unsigned holds) { return holds << static_cast<unsigned>(of); };
  const unsigned all = bit(Relation::Equal, equal) | bit(Relation::NotEqual, equal ^ 1) |
                       bit(Relation::LessEqual, not_above) | bit(Relation::Greater, not_above ^ 1) |
                       bit(Relation::GreaterEqual, not_below) | bit(Relation::Less, not_below ^ 1);
  return ((all >> static_cast<unsigned>(relation)) & 1) != 0;
}

// NaN is neither "less or equal" nor "more or equal", and so both less and more.
inline bool are_related(double left, Relation relation, double right) {
  const unsigned equal = is_equal(left, right) ? 1 : 0;
  return is_true(relation, equal | (left < right ? 1 : 0), equal | (left > right ? 1 : 0));
}

// The same of the progress of a node, as a barrier compares it.
inline bool are_related_as_progress(double left, Relation relation, double right) {
  return is_true(relation, left <= right + kProgressEpsilon ? 1 : 0,
                 left >= reached_from(right) ? 1 : 0);
}

// A comparison of a script.
inline bool is_true(const Instruction& comparison, double left, double right) {
  return comparison.whole == kOfProgress ? are_related_as_progress(left, comparison.relation, right)
                                         : are_related(left, comparison.relation, right);
}

// The number that it is, if a double has that exactly.
inline bool take_exactly(std::int64_t whole, double& number) {
  const bool is_exact = whole <= kLargestExact && whole >= -kLargestExact;
  if (is_exact) number = static_cast<double>(whole);
  return is_exact;
}
inline bool take(const Value& value, double& number) {
  if (const auto* real = std::get_if<double>(&value)) {
    number = *real;
    return true;
  }
  const auto* whole = std::get_if<std::int64_t>(&value);
  return whole != nullptr && take_exactly(*whole, number);
}

}  // namespace lockstep::host
