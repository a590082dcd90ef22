// The totals of the runs of one cell without their rows (--rows none): counts, sums, sketches.
// Totals of parts add up to the totals of the whole, bit for bit.
#pragma once

#include <vector>

#include "study/exact_sum.h"
#include "study/plan.h"
#include "study/quantile_sketch.h"
#include "study/results.h"
#include "study/row_text.h"
#include "study/sample_summary.h"

namespace lockstep::host {

class CellTotals {
 public:
  struct Column {
    ExactSum sum;
    QuantileSketch values;
  };

  explicit CellTotals(const StudyPlan& plan) : columns_(plan.columns.size()) {}
  CellTotals(ResultCounts results, std::vector<Column> columns)
      : results_(results), columns_(std::move(columns)) {}

  void add(const RowResult& row);
  void add(const CellTotals& other);

  // A summary of the runs with a value.
  SampleSummary summary(std::size_t column) const;
  const ResultCounts& results() const { return results_; }
  const std::vector<Column>& columns() const { return columns_; }

 private:
  ResultCounts results_;
  std::vector<Column> columns_;
};

}  // namespace lockstep::host
