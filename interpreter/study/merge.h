// Merges the parts of a study.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "study/plan.h"
#include "study/table.h"

namespace lockstep::host {

struct MergedStudy {
  StudyPlan plan;
  std::vector<SummaryRow> rows;
};

// Writes to `out` what one machine would have written. On failure, or when `stop_signal` returns a
// signal, nothing is left there; the problem has the reason and the parts.
Result<MergedStudy> merge_studies(std::span<const std::string> parts, const std::string& out,
                                  int (*stop_signal)());

}  // namespace lockstep::host
