// What a row of a plan can say: numbers that no run of it can have given are damage.
#pragma once

#include <optional>
#include <vector>

#include "measure/measure_spec.h"
#include "study/plan.h"
#include "study/row_text.h"

namespace lockstep {

class RowRules {
 public:
  // `plan` must outlive the rules.
  explicit RowRules(const StudyPlan& plan);

  // The rows that follow are of this cell.
  void enter(std::uint64_t cell);
  bool allow(const RowResult& row) const;

 private:
  bool allow(std::size_t column, const RowResult& row) const;
  bool allow_value(std::size_t column, double value, const RowResult& row) const;

  const StudyPlan& plan_;
  std::vector<MeasureSpec> measures_;  // of each column
  // Of the cell:
  double rate_ = 0;
  std::vector<bool> there_;  // each column
};

}  // namespace lockstep
