// Names, lists and numbers for messages: short, even if those of a document or a plugin are long.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/core/clock.h"

namespace lockstep::host {

// `name`, or its first letters and "…": no more than 256.
std::string brief(std::string_view name);

// "a, b, c" with ", " between. With fmt::join each unit would compile formatting again.
template <class Items>
std::string joined(const Items& items, std::string_view between) {
  std::string text;
  std::string_view before;
  for (const auto& item : items) {
    text += fmt::format("{}{}", before, item);
    before = between;
  }
  return text;
}

// "a, b and 3 more": the texts of `most` items at most.
template <class Items, class TextOf = std::identity>
std::string some_of(Items&& items, std::size_t most, TextOf text_of = {}) {
  std::string text;
  std::size_t count = 0;
  for (auto&& item : items) {
    if (++count > most) continue;
    if (count > 1) text += ", ";
    text += text_of(item);
  }
  if (count > most) text += " and " + std::to_string(count - most) + " more";
  return text;
}

// "'a', 'b' and 3 more": at most ten names, and no more of them than fit a line or two.
std::string listed(std::span<const std::string_view> names);

// "a -> b -> … (7 more) … -> y -> z": the beginning and the end of a long chain.
std::string chained(std::span<const std::string_view> names);

// "exactly one child", "one or more children", "2 to 4 children"; `most` of 2^32 - 1 is no limit.
std::string arity_text(std::uint32_t least, std::uint32_t most);

// "0.4 s". Of 3 s and more without a fraction, "35 s": who reads it has waited so long.
std::string duration_text(Nanoseconds time);

// "35.88": four digits, and all that stand before the point.
std::string rounded(double value);
// Among values that are `range` apart: three digits of that, and no more than it has. "37.80" from
// 33 to 41.
std::string rounded_within(double value, double range);

// "1 tick", "2 ticks".
std::string counted(std::uint64_t count, std::string_view noun);

}  // namespace lockstep::host
