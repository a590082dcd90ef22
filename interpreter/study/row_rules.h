// The possible values of a row of a plan: numbers that no run can have mean that the file is
// damaged.
#pragma once

#include <optional>
#include <vector>

#include "judge/measure/measure.h"
#include "study/plan.h"
#include "study/row_text.h"

namespace lockstep::host {

class RowRules {
 public:
  // `plan` must outlive the rules.
  explicit RowRules(const StudyPlan& plan);

  // The following rows belong to this cell.
  void enter(std::uint64_t cell);
  bool allow(const RowResult& row) const;

 private:
  bool allow(std::size_t column, const RowResult& row) const;
  bool allow_value(std::size_t column, double value, const RowResult& row) const;

  const StudyPlan& plan_;
  std::vector<MeasureSpec> measures_;  // of each column
  // The rest belongs to the cell.
  double rate_ = 0;
  std::vector<bool> there_;  // each column
};

}  // namespace lockstep::host
