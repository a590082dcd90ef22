#include "study/plan_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <set>

#include "base/core/wording.h"
#include "judge/measure/measure_spec.h"
#include "study/column_names.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kMostRows = std::uint64_t{1} << 48u;

template <class Number>
std::optional<Number> whole(std::string_view text) {
  Number number{};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool good = failure == std::errc() && end == text.data() + text.size();
  return good ? std::optional(number) : std::nullopt;
}

// It is the name of a column.
bool is_name(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

bool is_value(const GridAxis& axis, const std::string& value) {
  if (axis.kind == GridAxis::Kind::Seed) return count_from(value).has_value();
  if (axis.kind == GridAxis::Kind::Rate) return rate_from(value).has_value();
  return value.find_first_of("\r\n") == std::string::npos;
}

// Axes that vary together have as many values, and all of them together none twice.
std::string check_together(std::span<const GridAxis> grid) {
  while (!grid.empty()) {
    const auto rest = grid.subspan(1);
    const auto end = std::ranges::find(rest, false, &GridAxis::follows);
    const auto together = grid.first(1 + static_cast<std::size_t>(end - rest.begin()));
    const GridAxis& first = together.front();
    if (first.follows) return fmt::format("'{}' in 'grid' follows nothing", first.name);
    for (const GridAxis& axis : together) {
      if (axis.values.size() == first.values.size()) continue;
      return fmt::format("'{}' and '{}' in 'grid' do not have as many values", first.name,
                         axis.name);
    }
    if (const auto twice = value_twice(together); !twice.empty())
      return fmt::format("'{}' in 'grid' has the value '{}' twice", first.name, twice);
    grid = grid.subspan(together.size());
  }
  return {};
}

std::string check_grid(const std::vector<GridAxis>& grid) {
  std::set<std::string> names;
  for (const GridAxis& axis : grid) {
    if (!is_name(axis.name)) return fmt::format("'{}' is not a name for 'grid'", axis.name);
    if (!names.insert(axis.name).second) return fmt::format("'{}' is twice in 'grid'", axis.name);
    if (axis.values.empty()) return fmt::format("'{}' in 'grid' has no values", axis.name);
    for (const std::string& value : axis.values) {
      if (is_value(axis, value)) continue;
      return fmt::format("'{}' in 'grid' cannot have the value '{}'", axis.name, value);
    }
  }
  return check_together(grid);
}

std::string check_measures(const std::vector<std::string>& measures) {
  for (const std::string& text : measures) {
    const auto measure = parse_measure(text);
    if (!measure) return measure.error().message;
    if (to_text(*measure) != text) return fmt::format("'{}' is not how a measure is written", text);
  }
  return {};
}

bool is_rising(const std::vector<std::uint64_t>& numbers, std::uint64_t end) {
  return std::ranges::adjacent_find(numbers, std::greater_equal<>()) == numbers.end() &&
         (numbers.empty() || numbers.back() < end);
}

bool has_gap(const StudyColumn& column) {
  const auto spec = parse_measure(column.measure);
  return spec && spec->measure->has_gap && !column.is_gap;
}

// A gap follows the value that it is of, and nothing else does.
bool may_follow(const StudyColumn& before, const StudyColumn& column) {
  return has_gap(before) ? column.is_gap && column.measure == before.measure &&
                               column.node == before.node && column.cells == before.cells
                         : !column.is_gap;
}

std::string check_columns(const StudyPlan& plan) {
  const std::set<std::string> measures(plan.measures.begin(), plan.measures.end());
  const std::uint64_t cells = cell_count(plan);
  std::set<std::string> names;
  StudyColumn before;
  for (const StudyColumn& column : plan.columns) {
    const std::string name = column_name(column);
    if (!measures.contains(column.measure))
      return fmt::format("'{}' is in 'columns' but not in 'measures'", column.measure);
    if (!names.insert(name).second) return fmt::format("'{}' is twice in 'columns'", name);
    if (!is_rising(column.cells, cells))
      return fmt::format("the 'cells' of '{}' are not cells in their order", name);
    if (!may_follow(before, column))
      return fmt::format("'{}' is at the wrong place in 'columns'", name);
    before = column;
  }
  return has_gap(before) ? fmt::format("'columns' has no gap of '{}'", before.measure) : "";
}

}  // namespace

std::optional<std::uint64_t> count_from(std::string_view text) {
  return whole<std::uint64_t>(text);
}

std::optional<double> rate_from(std::string_view text) {
  const auto rate = whole<double>(text);
  return rate && *rate >= kLeastRate && *rate <= kMostRate ? rate : std::nullopt;
}

namespace {

// The same for 0.5, .5 and 0.50. Seeds may be larger than a double tells apart.
std::string as_number(const std::string& value) {
  if (const auto number = whole<std::uint64_t>(value)) return std::to_string(*number);
  const auto number = whole<double>(value);
  if (!number) return value;
  return fmt::format("{:.17g}", *number + 0.0);  // -0 is 0
}

}  // namespace

std::string value_twice(std::span<const GridAxis> together) {
  std::set<std::vector<std::string>> seen;
  for (std::size_t i = 0; i < together.front().values.size(); ++i) {
    std::vector<std::string> values, numbers;
    for (const GridAxis& axis : together) {
      values.push_back(axis.values[i]);
      numbers.push_back(as_number(values.back()));
    }
    if (!seen.insert(numbers).second) return joined(values, ":");
  }
  return {};
}

std::string check_size(const StudyPlan& plan) {
  std::uint64_t rows = plan.runs;
  if (rows == 0) return "a study has at least one run";
  for (const GridAxis& axis : plan.grid) {
    if (axis.follows) continue;
    if (rows > kMostRows / std::max<std::size_t>(axis.values.size(), 1))
      rows = kMostRows + 1;
    else
      rows *= axis.values.size();
  }
  if (rows > kMostRows) return fmt::format("the study has more than {} runs", kMostRows);
  return {};
}

std::string check_plan(const StudyPlan& plan) {
  if (auto error = check_size(plan); !error.empty()) return error;
  const auto [part, of] = plan.shard;
  if (part < 1 || part > of || of > plan.runs)
    return fmt::format("{} runs have no part {} of {}", plan.runs, part, of);
  if (plan.precision && of != 1) return "a study with 'until_ci' has no parts";
  if (plan.precision && plan.rows == StudyRows::None)
    return "a study with 'until_ci' has rows, since all of a cell decide when it ends";
  if (!(plan.rate >= kLeastRate && plan.rate <= kMostRate))
    return fmt::format("'rate' is {}, expected {} to {}", plan.rate, kLeastRate, kMostRate);
  if (plan.max_ticks == 0) return "'max_ticks' is 0, expected 1 or more";
  if (auto error = check_grid(plan.grid); !error.empty()) return error;
  if (auto error = check_measures(plan.measures); !error.empty()) return error;
  return check_columns(plan);
}

}  // namespace lockstep::host
