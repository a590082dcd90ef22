// The text of cells.jsonl: a line of JSON for each cell of a study without rows.
#pragma once

#include <string>

#include "base/core/problem.h"
#include "study/cell_totals.h"
#include "study/plan.h"

namespace lockstep::host {

// With the end of the line. The same runs give the same bytes.
std::string totals_line(std::uint64_t cell, const CellTotals& totals);

// Accepts only the exact bytes that totals_line() gives for at least one and at most `runs` runs of
// this cell, exactly `runs` if `is_whole`.
Result<CellTotals> read_totals_line(std::string line, const StudyPlan& plan, std::uint64_t cell,
                                    bool is_whole);

}  // namespace lockstep::host
