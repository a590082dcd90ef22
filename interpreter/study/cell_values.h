// The runs of one cell, taken apart by column.
#pragma once

#include <vector>

#include "study/plan.h"
#include "study/results.h"
#include "study/row_text.h"
#include "study/sample_summary.h"

namespace lockstep::host {

class CellValues {
 public:
  explicit CellValues(const StudyPlan& plan) : values_(plan.columns.size()) {}

  void add(const RowResult& row);
  void clear();  // for the next cell

  // A summary of the runs with a value.
  SampleSummary summary(std::size_t column) const { return summarize(values_[column]); }
  const ResultCounts& results() const { return results_; }

 private:
  std::vector<std::vector<double>> values_;
  ResultCounts results_;
};

}  // namespace lockstep::host
