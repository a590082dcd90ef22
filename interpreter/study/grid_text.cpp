#include "study/grid_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace lockstep::host {
namespace {

using Texts = std::vector<std::string>;

Texts split(std::string_view text, char separator) {
  Texts parts;
  for (;;) {
    const auto end = std::min(text.find(separator), text.size());
    parts.emplace_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

// A decimal number is exact: it is digits / 10^decimals.
struct Decimal {
  std::int64_t digits = 0;
  std::size_t decimals = 0;
};

constexpr std::size_t kMostDigits = 15;  // with sign and point; 64 bits hold a sum of two

// "-0.25"; no exponent.
bool is_decimal(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return std::ranges::count(text, '.') <= 1 && std::ranges::any_of(text, is_digit) &&
         std::ranges::all_of(text, [&](char c) { return is_digit(c) || c == '.'; });
}

Decimal decimal_of(std::string_view text) {
  Decimal number;
  bool after_point = false;
  for (const char c : text) {
    if (c >= '0' && c <= '9') number.digits = number.digits * 10 + (c - '0');
    if (after_point) ++number.decimals;
    after_point |= c == '.';
  }
  if (text.starts_with('-')) number.digits = -number.digits;
  return number;
}

// The shortest that reads back the same.
std::string to_text(Decimal number) {
  while (number.decimals > 0 && number.digits % 10 == 0) {
    number.digits /= 10;
    --number.decimals;
  }
  const bool negative = number.digits < 0;
  std::string text =
      fmt::format("{:0{}}", negative ? -number.digits : number.digits, number.decimals + 1);
  if (number.decimals > 0) text.insert(text.size() - number.decimals, ".");
  return negative ? '-' + text : text;
}

struct Range {
  std::int64_t first = 0, last = 0, step = 0;
  std::size_t decimals = 0;  // of all three
};

// From three numbers; none if they have too many digits to be exact.
std::optional<Range> range_of(const Texts& parts) {
  std::array<Decimal, 3> numbers;
  Range range;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (parts[i].size() > kMostDigits) return std::nullopt;
    numbers[i] = decimal_of(parts[i]);
    range.decimals = std::max(range.decimals, numbers[i].decimals);
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t more = range.decimals - numbers[i].decimals;
    if (parts[i].size() + more > kMostDigits) return std::nullopt;
    for (std::size_t n = 0; n < more; ++n) numbers[i].digits *= 10;
  }
  range.first = numbers[0].digits;
  range.last = numbers[1].digits;
  range.step = numbers[2].digits;
  return range;
}

Result<Texts> values_of(std::string_view name, const Texts& parts) {
  const auto range = range_of(parts);
  const auto wrong = [&](std::string_view why) {
    return problem(fmt::format("--grid {}: {}", name, why),
                   "a range is first:last:step, as 0:1:0.1 or 1:0:-0.1");
  };
  if (!range) return wrong("the numbers of the range have too many digits");
  if (range->step == 0) return wrong("the step of the range is 0");
  const std::int64_t way = range->last - range->first;
  if (way != 0 && (way < 0) != (range->step < 0))
    return wrong(
        fmt::format("a step of {} does not lead from {} to {}", parts[2], parts[0], parts[1]));
  const auto steps = static_cast<std::uint64_t>(way / range->step);
  if (steps >= kMostCells)
    return wrong(
        fmt::format("the range has {} values, at most {} are allowed", steps + 1, kMostCells));
  Texts values;
  for (std::uint64_t i = 0; i <= steps; ++i)
    values.push_back(
        to_text({range->first + static_cast<std::int64_t>(i) * range->step, range->decimals}));
  return values;
}

Result<std::vector<GridAxis>> one_axis(std::string_view name, std::string_view text) {
  const Texts parts = split(text, ':');
  const bool is_range = parts.size() == 3 && std::ranges::all_of(parts, is_decimal);
  auto values = is_range ? values_of(name, parts) : split(text, ',');
  if (!values) return tl::unexpected(values.error());
  return std::vector<GridAxis>{{.name = std::string(name), .values = std::move(*values)}};
}

Result<std::vector<GridAxis>> several_axes(std::string_view all, const Texts& names,
                                           std::string_view text) {
  std::vector<GridAxis> axes;
  for (const std::string& name : names) axes.push_back({.name = name, .follows = !axes.empty()});
  for (const std::string& together : split(text, ',')) {
    const Texts values = split(together, ':');
    if (values.size() != axes.size()) {
      return problem(
          fmt::format("--grid {}: '{}' has {} of {} values", all, together, values.size(),
                      axes.size()),
          "a value for each name, with ':' between them, as speed,delta=0.1:0.2,0.2:0.1");
    }
    for (std::size_t i = 0; i < axes.size(); ++i) axes[i].values.push_back(values[i]);
  }
  return axes;
}

}  // namespace

Result<std::vector<GridAxis>> parse_grid(std::string_view text) {
  const auto equals = std::min(text.find('='), text.size());
  const std::string_view name = text.substr(0, equals);
  const Texts names = split(name, ',');
  if (equals + 1 >= text.size() || std::ranges::find(names, "") != names.end())
    return problem(fmt::format("--grid {}: expected name=value,value,…", text));
  const std::string_view values = text.substr(equals + 1);
  if (names.size() == 1) return one_axis(name, values);
  if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
    return problem(fmt::format("--grid {}: a name is given twice", name));
  return several_axes(name, names, values);
}

}  // namespace lockstep::host
