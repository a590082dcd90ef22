#include "core/parameter_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/wording.h"

namespace lockstep {
namespace {

// The first number of a value that the range does not allow.
std::optional<double> out_of_range(const Range& range, const Value& value) {
  const auto outside = [&](double number) {
    const bool above = range.min_excluded ? number > range.min : number >= range.min;
    return !above || number > range.max;
  };
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    const auto number = static_cast<double>(*integer);
    if (outside(number)) return number;
  } else if (const auto* number = std::get_if<double>(&value)) {
    if (outside(*number)) return *number;
  } else if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    const auto it = std::find_if(list->begin(), list->end(), outside);
    if (it != list->end()) return *it;
  }
  return std::nullopt;
}

}  // namespace

std::optional<RuleBreak> refuse_value(const Parameter& parameter, const Value& value) {
  if (const auto number = out_of_range(parameter.range, value)) {
    return RuleBreak{
        .message = fmt::format("{} is outside the range of '{}'", *number, parameter.name),
        .hint = "it must be " + range_text(parameter.range)};
  }
  if (parameter.choices.empty()) return std::nullopt;
  const auto* word = std::get_if<std::string>(&value);
  if (word == nullptr || std::ranges::find(parameter.choices, *word) != parameter.choices.end()) {
    return std::nullopt;
  }
  return RuleBreak{
      .message = fmt::format("'{}' is not a value of '{}'", brief(*word), parameter.name),
      .hint = "it must be one of " + listed(parameter.choices)};
}

std::string range_text(const Range& range) {
  const bool has_min = std::isfinite(range.min);
  const bool has_max = std::isfinite(range.max);
  if (!has_min && !has_max) return {};
  const std::string_view above = range.min_excluded ? "more than" : "at least";
  if (has_min && has_max && !range.min_excluded) {
    return fmt::format("from {} to {}", range.min, range.max);
  }
  if (has_min && has_max) return fmt::format("{} {}, at most {}", above, range.min, range.max);
  if (has_min) return fmt::format("{} {}", above, range.min);
  return fmt::format("at most {}", range.max);
}

}  // namespace lockstep
