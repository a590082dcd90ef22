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

RowRules::RowRules(const StudyPlan& plan) : plan_(plan) {
  std::string unheard;  // a plan that was checked has no other measures
  for (const StudyColumn& column : plan.columns) {
    measures_.push_back(parse_measure(column.measure, unheard).value_or(MeasureSpec{}));
  }
}

void RowRules::enter(std::uint64_t cell) {
  rate_ = cell_rate(plan_, cell);
}

bool RowRules::allow(const MeasureSpec& measure, double value, std::uint64_t ticks) const {
  switch (measure.kind) {
    case MeasureKind::ProgressDistance:
      return value >= 0;
    case MeasureKind::StepLength:
      return value >= 0 && value <= 1;
    case MeasureKind::Duration:
      return value == static_cast<double>(ticks) / rate_;
    case MeasureKind::Predictability:
      return is_instant(value, measure.expected.value_or(0), ticks);
  }
  return false;
}

bool RowRules::allow(const RowResult& row) const {
  if (row.ticks == 0 || row.ticks > plan_.max_ticks) return false;
  if (row.result == StudyResult::Limit && row.ticks != plan_.max_ticks) return false;
  for (std::size_t column = 0; column < measures_.size(); ++column) {
    const double value = row.values[column];
    if (!std::isnan(value) && !(std::isfinite(value) && allow(measures_[column], value, row.ticks)))
      return false;
  }
  return true;
}

}  // namespace lockstep
