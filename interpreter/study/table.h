// The summary of a study: the numbers of a box plot for each cell, node and measure.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "study/column_names.h"
#include "study/plan.h"
#include "study/results.h"
#include "study/sample_summary.h"

namespace lockstep::host {

// A row of summary.csv.
struct SummaryRow {
  std::vector<std::string> grid;  // a value for each grid name, in their order
  std::string node;               // its path
  std::string measure;            // as to_text(MeasureSpec) writes it
  SampleSummary summary;  // of the runs that have a value; without any only count, 0, counts
  ResultCounts results;   // of all runs of the cell
  // The median over the runs, of a measure that has one, as a predictability.
  std::optional<double> gap;

  // In the order of kIntervalColumns: the ends of the 95 % confidence intervals, of the median and
  // of the share of each result. Of the median there may be none.
  std::array<std::optional<double>, kIntervalColumns.size()> intervals() const;

  // True if the gap is so large that the instants mean little.
  bool is_far() const { return gap.value_or(0) > kFarGap; }
  static constexpr double kFarGap = 0.1;
};

// From a complete file of results. A column that a cell does not have gives no row.
Result<std::vector<SummaryRow>> summarize_study(const std::string& path, const StudyPlan& plan);

// "<grid>,node,measure,…" (column_names.h), and a line for each row. What there is not is empty.
std::string summary_csv(const StudyPlan& plan, const std::vector<SummaryRow>& rows);

}  // namespace lockstep::host
