#include "study/plan.h"

#include <algorithm>
#include <charconv>

#include "base/core/random.h"

namespace lockstep::host {
namespace {

template <class Number>
Number value_of(const StudyPlan& plan, GridAxis::Kind kind, std::uint64_t cell, Number otherwise) {
  const auto values = cell_values(plan, cell);
  for (std::size_t axis = 0; axis < values.size(); ++axis) {
    if (plan.grid[axis].kind != kind) continue;
    const std::string& text = values[axis];
    std::from_chars(text.data(), text.data() + text.size(), otherwise);
  }
  return otherwise;
}

}  // namespace

std::uint64_t cell_count(const StudyPlan& plan) {
  std::uint64_t cells = 1;
  for (const GridAxis& axis : plan.grid) cells *= axis.follows ? 1 : axis.values.size();
  return cells;
}

std::size_t last_axes(const std::vector<GridAxis>& grid) {
  std::size_t count = 0;
  while (count < grid.size() && grid[grid.size() - ++count].follows) continue;
  return count;
}

std::vector<std::string> cell_values(const StudyPlan& plan, std::uint64_t cell) {
  std::vector<std::string> values(plan.grid.size());
  for (std::size_t axis = plan.grid.size(); axis-- > 0;) {
    const auto& all = plan.grid[axis].values;
    values[axis] = all[cell % all.size()];
    if (!plan.grid[axis].follows) cell /= all.size();
  }
  return values;
}

std::string cell_text(const StudyPlan& plan, std::uint64_t cell) {
  const auto values = cell_values(plan, cell);
  std::string text;
  for (std::size_t axis = 0; axis < values.size(); ++axis) {
    if (axis != 0) text += ", ";
    text += plan.grid[axis].name + '=' + values[axis];
  }
  return text;
}

bool has_column(const StudyColumn& column, std::uint64_t cell) {
  return column.cells.empty() || std::ranges::binary_search(column.cells, cell);
}

std::uint64_t cell_seed(const StudyPlan& plan, std::uint64_t cell) {
  return value_of(plan, GridAxis::Kind::Seed, cell, plan.seed);
}

double cell_rate(const StudyPlan& plan, std::uint64_t cell) {
  return value_of(plan, GridAxis::Kind::Rate, cell, plan.rate);
}

std::uint64_t runs_of_part(const StudyPlan& plan) {
  return (plan.runs + plan.shard.of - plan.shard.part) / plan.shard.of;
}

std::uint64_t row_count(const StudyPlan& plan) {
  return cell_count(plan) * runs_of_part(plan);
}

StudyRow row_at(const StudyPlan& plan, std::uint64_t row) {
  const std::uint64_t runs = runs_of_part(plan);
  return {row / runs, plan.shard.part - 1 + row % runs * plan.shard.of};
}

std::uint64_t run_seed(std::uint64_t seed, std::uint64_t cell, std::uint64_t run) {
  return RandomStream(RandomStream(seed, cell).next(), run).next();
}

}  // namespace lockstep::host
