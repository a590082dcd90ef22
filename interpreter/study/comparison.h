// Two cells of a study, measure by measure.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/core/problem.h"
#include "study/plan.h"
#include "study/rank_tests.h"
#include "study/shift.h"

namespace lockstep::host {

using CellPair = std::pair<std::uint64_t, std::uint64_t>;

struct Comparison {
  std::string node, measure;
  std::pair<std::size_t, std::size_t> count = {};  // runs with a value; of a paired study, pairs
  // Without a value on one side there is nothing more.
  struct Found {
    std::pair<double, double> medians;
    Shift shift;  // of the second cell; of the same test
    RankTest test;
    double p_holm = 1;
  };
  std::optional<Found> found = {};
};

// From a complete runs.csv, for each column that both cells have. Of a paired study by signed
// ranks, else by Mann-Whitney's test. `cells` are cells of the plan.
Result<std::vector<Comparison>> compare_cells(const std::string& path, const StudyPlan& plan,
                                              CellPair cells);

}  // namespace lockstep::host
