#include "study/row_sequence.h"

#include <algorithm>

#include "study/precision.h"

namespace lockstep::host {

RowSequence::RowSequence(const StudyPlan& plan)
    : plan_(&plan),
      values_(plan),
      last_(plan.precision ? std::min(plan.runs, next_look(0)) : row_count(plan)) {}

std::optional<StudyRow> RowSequence::next() const {
  return first_ == last_ ? std::nullopt : std::optional(row_at(*plan_, first_));
}

void RowSequence::add(const RowResult& row) {
  ++count_;
  ++first_;
  if (!plan_->precision) return;
  values_.add(row);
  if (first_ < last_) return;
  const std::uint64_t runs = plan_->runs, cell = (first_ - 1) / runs;
  const std::uint64_t end = (cell + 1) * runs;
  std::uint64_t of_cell = first_ - cell * runs;
  if (of_cell == runs || has_enough(cell)) {
    values_.clear();
    first_ = end;
    of_cell = 0;
  }
  const std::uint64_t more = next_look(of_cell) - of_cell;
  last_ = first_ == row_count(*plan_) ? first_ : first_ + std::min(more, runs - of_cell);
}

bool RowSequence::has_enough(std::uint64_t cell) const {
  for (std::size_t i = 0; i < plan_->columns.size(); ++i) {
    const StudyColumn& column = plan_->columns[i];
    if (column.is_gap || !has_column(column, cell)) continue;
    if (!is_narrow(*plan_->precision, column.measure, values_.summary(i), values_.results()))
      return false;
  }
  return true;
}

}  // namespace lockstep::host
