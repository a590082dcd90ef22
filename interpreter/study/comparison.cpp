#include "study/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/ranks.h"
#include "study/row_reader.h"
#include "study/sample_summary.h"

namespace lockstep::host {
namespace {

using Values = std::vector<double>;   // run after run; NaN: the run has none
using Columns = std::vector<Values>;  // of one cell

Result<std::pair<Columns, Columns>> read_cells(const std::string& path, const StudyPlan& plan,
                                               CellPair cells) {
  RowReader reader(path, plan);
  const Columns empty(plan.columns.size());
  std::pair<Columns, Columns> columns{empty, empty};
  while (!reader.next().empty()) {
    const std::uint64_t cell = reader.cell();
    if (cell != cells.first && cell != cells.second) continue;
    Columns& side = cell == cells.first ? columns.first : columns.second;
    for (std::size_t i = 0; i < side.size(); ++i) side[i].push_back(reader.row().values[i]);
  }
  if (auto error = reader.incomplete(); !error.empty()) return problem(std::move(error));
  return columns;
}

Values without_missing(const Values& values) {
  Values there;
  for (const double value : values) {
    if (!std::isnan(value)) there.push_back(value);
  }
  return there;
}

// Values of both cells that are equal but for rounding are made equal.
void tie_samples(Values& first, Values& second) {
  Values all = first, roundings;
  all.insert(all.end(), second.begin(), second.end());
  for (const double value : all) roundings.push_back(rounding_of(value));
  tie_equal(all, roundings);
  std::copy_n(all.begin(), first.size(), first.begin());
  std::copy(all.begin() + std::ssize(first), all.end(), second.begin());
}

void compare(Values first, Values second, Comparison& comparison) {
  comparison.count = {first.size(), second.size()};
  if (first.empty() || second.empty()) return;
  tie_samples(first, second);
  comparison.found = {.medians = {summarize(first).median, summarize(second).median},
                      .shift = shift_between(first, second),
                      .test = mann_whitney(first, second)};
}

void compare_pairs(const Values& first, const Values& second, Comparison& comparison) {
  Values both_first, both_second, differences, roundings;
  const std::size_t runs = std::min(first.size(), second.size());
  for (std::size_t run = 0; run < runs; ++run) {
    const double difference = second[run] - first[run];
    if (std::isnan(difference)) continue;
    both_first.push_back(first[run]);
    both_second.push_back(second[run]);
    differences.push_back(difference);
    roundings.push_back(rounding_of(std::max(std::abs(first[run]), std::abs(second[run]))));
  }
  comparison.count = {differences.size(), differences.size()};
  if (differences.empty()) return;
  tie_differences(differences, roundings);
  comparison.found = {.medians = {summarize(both_first).median, summarize(both_second).median},
                      .shift = shift_of(differences),
                      .test = signed_rank(differences)};
}

void adjust(std::vector<Comparison>& comparisons) {
  Values p;
  for (const Comparison& it : comparisons) {
    if (it.found) p.push_back(it.found->test.p);
  }
  const Values adjusted = holm(p);
  auto next = adjusted.begin();
  for (Comparison& it : comparisons) {
    if (it.found) it.found->p_holm = *next++;
  }
}

}  // namespace

Result<std::vector<Comparison>> compare_cells(const std::string& path, const StudyPlan& plan,
                                              CellPair cells) {
  const auto columns = read_cells(path, plan, cells);
  if (!columns) return tl::unexpected(columns.error());
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const StudyColumn& column = plan.columns[i];
    if (column.is_gap || !has_column(column, cells.first) || !has_column(column, cells.second))
      continue;
    const Values &first = columns->first[i], &second = columns->second[i];
    Comparison& comparison = comparisons.emplace_back(Comparison{column.node, column.measure});
    if (plan.paired) {
      compare_pairs(first, second, comparison);
    } else {
      compare(without_missing(first), without_missing(second), comparison);
    }
  }
  adjust(comparisons);
  return comparisons;
}

}  // namespace lockstep::host
