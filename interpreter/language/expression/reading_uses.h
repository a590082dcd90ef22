// What a script does with the progress of nodes, for those who know progress in parts only.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "language/expression/expression.h"

namespace lockstep::host {

struct ProgressUse {
  std::uint32_t reading;           // in Expression::readings()
  std::optional<double> constant;  // that it is compared with; nothing: it is used otherwise
};

// Each place where the progress of a node is read: progress(arm) >= 0.5, or 0.5 <= progress(arm).
std::vector<ProgressUse> progress_uses(const Expression& script);

}  // namespace lockstep::host
