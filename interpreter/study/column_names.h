// The columns of runs.csv and summary.csv. No two columns of a file have the same name.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "study/plan.h"

namespace lockstep::host {

// In this order. A column per grid name follows the cell, those of the measures follow the result.
constexpr std::array<std::string_view, 5> kRowColumns{"cell", "run", "seed", "ticks", "result"};
// After a column per grid name.
constexpr std::array<std::string_view, 14> kSummaryColumns{
    "node", "measure", "min",  "q1",      "median",  "q3",    "max",
    "mean", "n",       "runs", "success", "failure", "limit", "gap"};
// After these; no grid name has a hyphen.
constexpr std::array<std::string_view, 8> kIntervalColumns{
    "median-low",  "median-high",  "success-low", "success-high",
    "failure-low", "failure-high", "limit-low",   "limit-high"};

// The column of each grid name, in both files: the name itself, or grid_<name> if lockstep has a
// column of that name, as for `--grid seed=1,2`.
std::vector<std::string> grid_columns(const StudyPlan& plan);
// "duration Main"; of a gap "gap predictability:arm@0.6 Main/pull/arm".
std::string column_name(const StudyColumn& column);

}  // namespace lockstep::host
