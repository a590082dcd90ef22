// One --grid, as a user writes it, and the axes that it makes:
//   noise=0,0.01,0.05             a list of values
//   noise=0:1:0.1                 a range of numbers: first, last, step
//   speed,delta=0.1:0.2,0.2:0.1   several names whose values belong together
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/core/problem.h"
#include "study/plan.h"

namespace lockstep::host {

constexpr std::uint64_t kMostCells = 100'000;

// All axes after the first have `follows`. Each has a value at least, and none is named twice.
Result<std::vector<GridAxis>> parse_grid(std::string_view text);

}  // namespace lockstep::host
