#include "study/row_rules.h"

#include <cmath>

#include "judge/measure/measure_spec.h"

namespace lockstep::host {
RowRules::RowRules(const StudyPlan& plan) : plan_(plan), there_(plan.columns.size()) {
  // A plan that was checked has no measures that cannot be read.
  for (const StudyColumn& column : plan.columns) {
    measures_.push_back(parse_measure(column.measure).value());
  }
}

void RowRules::enter(std::uint64_t cell) {
  rate_ = cell_rate(plan_, cell);
  for (std::size_t column = 0; column < there_.size(); ++column) {
    there_[column] = has_column(plan_.columns[column], cell);
  }
}

bool RowRules::allow_value(std::size_t column, double value, const RowResult& row) const {
  if (plan_.columns[column].is_gap) return value >= 0 && value <= 1;
  const MeasureSpec& spec = measures_[column];
  const bool succeeded = row.result == StudyResult::Success;
  return spec.measure->is_possible(value, spec,
                                   {.ticks = row.ticks, .rate = rate_, .succeeded = succeeded});
}

bool RowRules::allow(std::size_t column, const RowResult& row) const {
  const double value = row.values[column];
  if (std::isnan(value)) return true;
  // An instant that was reached is some way from its target.
  const bool has_gap = column + 1 < there_.size() && plan_.columns[column + 1].is_gap;
  if (has_gap && std::isnan(row.values[column + 1])) return false;
  return there_[column] && allow_value(column, value, row);
}

bool RowRules::allow(const RowResult& row) const {
  if (row.ticks == 0 || row.ticks > plan_.max_ticks) return false;
  if (row.result == StudyResult::Limit && row.ticks != plan_.max_ticks) return false;
  for (std::size_t column = 0; column < there_.size(); ++column) {
    if (!allow(column, row)) return false;
  }
  return true;
}

}  // namespace lockstep::host
