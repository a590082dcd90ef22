// The summary of a study on stdout.
#pragma once

#include <string>
#include <vector>

#include "study/table.h"

namespace lockstep::host {

// Aligned, with a line of names above. A gap that is far has a '!'.
// A table for each measure, and one of how the runs ended, no wider than `width`.
std::string summary_table(const StudyPlan& plan, const std::vector<SummaryRow>& rows,
                          std::size_t width);
// One line: an array of the rows of summary.csv, the values of the grid under "cell".
std::string summary_json(const StudyPlan& plan, const std::vector<SummaryRow>& rows);
// Warnings about them: a line for each node and measure whose target is far, or whose interval is
// not as narrow as the plan wants.
std::vector<std::string> summary_warnings(const StudyPlan& plan,
                                          const std::vector<SummaryRow>& rows);

}  // namespace lockstep::host
