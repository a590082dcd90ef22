// The summary of a study: of each cell, node and measure the numbers that a box plot is drawn from.
#pragma once

#include <string>
#include <vector>

#include "study/box_plot.h"
#include "study/plan.h"

namespace lockstep {

// From a complete runs.csv. A column that a cell does not have gives no row. On failure `error`
// tells why.
std::vector<SummaryRow> summarize_runs(const std::string& path, const StudyPlan& plan,
                                       std::string& error);

// "<grid>,node,measure,min,q1,median,q3,max,mean,n", and a line for each row.
std::string summary_csv(const StudyPlan& plan, const std::vector<SummaryRow>& rows);

}  // namespace lockstep
