// Puts the parts of a study together.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/problem.h"
#include "study/folder.h"

namespace lockstep {

struct MergedStudy {
  StudyPlan plan;
  std::vector<SummaryRow> rows;
};

// Writes to `out` what one machine would have written. On failure, or when `stop_signal` gives a
// number, nothing is left there; the problem names the parts that do not fit together.
Result<MergedStudy> merge_studies(std::span<const std::string> parts, const std::string& out,
                                  int (*stop_signal)());

}  // namespace lockstep
