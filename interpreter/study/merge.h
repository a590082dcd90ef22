// Puts the parts of a study together.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/folder.h"

namespace lockstep {

// Writes to `out` what one machine would have written. On failure, or when `stop_signal` gives a
// number, nothing is left there, and `error` tells which parts do not fit together, and why.
std::optional<std::vector<SummaryRow>> merge_studies(std::span<const std::string> parts,
                                                     const std::string& out, int (*stop_signal)(),
                                                     StudyPlan& plan, std::string& error);

}  // namespace lockstep
