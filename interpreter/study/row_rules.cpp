#include "study/row_rules.h"

#include <cmath>

namespace lockstep {
namespace {

// A number of ticks, minus the expected one.
bool is_instant(double value, double expected, std::uint64_t ticks) {
  const double instant = std::round(value + expected);
  return instant >= 0 && instant <= static_cast<double>(ticks) && instant - expected == value;
}

}  // namespace

RowRules::RowRules(const StudyPlan& plan) : plan_(plan), there_(plan.columns.size()) {
  std::string unheard;  // a plan that was checked has no other measures
  for (const StudyColumn& column : plan.columns) {
    measures_.push_back(parse_measure(column.measure, unheard).value_or(MeasureSpec{}));
  }
}

void RowRules::enter(std::uint64_t cell) {
  rate_ = cell_rate(plan_, cell);
  for (std::size_t column = 0; column < there_.size(); ++column) {
    there_[column] = has_column(plan_.columns[column], cell);
  }
}

bool RowRules::allow_value(std::size_t column, double value, std::uint64_t ticks) const {
  if (plan_.columns[column].is_gap) return value >= 0 && value <= 1;
  const MeasureSpec& measure = measures_[column];
  switch (measure.kind) {
    case MeasureKind::ProgressDistance:
      return value >= 0 && std::isfinite(value);
    case MeasureKind::StepLength:
      return value >= 0 && value <= 1;
    case MeasureKind::Duration:
      return value == static_cast<double>(ticks) / rate_;
    case MeasureKind::Predictability:
      return is_instant(value, measure.expected.value_or(0), ticks);
  }
  return false;
}

bool RowRules::allow(std::size_t column, const RowResult& row) const {
  const double value = row.values[column];
  if (std::isnan(value)) return true;
  // An instant that was reached is some way from its target.
  const bool has_gap = column + 1 < there_.size() && plan_.columns[column + 1].is_gap;
  if (has_gap && std::isnan(row.values[column + 1])) return false;
  return there_[column] && allow_value(column, value, row.ticks);
}

bool RowRules::allow(const RowResult& row) const {
  if (row.ticks == 0 || row.ticks > plan_.max_ticks) return false;
  if (row.result == StudyResult::Limit && row.ticks != plan_.max_ticks) return false;
  for (std::size_t column = 0; column < there_.size(); ++column) {
    if (!allow(column, row)) return false;
  }
  return true;
}

}  // namespace lockstep
