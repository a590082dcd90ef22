// What must hold between the numbers and names of a plan, whoever has written it: the command line
// or a study.json.
#pragma once

#include <optional>
#include <string>

#include "study/plan.h"

namespace lockstep {

constexpr double kLeastRate = 0.001, kMostRate = 100000;

// A whole number, and the value of a grid over the rate, if the whole text is one.
std::optional<std::uint64_t> count_from(std::string_view text);
std::optional<double> rate_from(std::string_view text);

// "", or what is wrong with the plan.
std::string check_plan(const StudyPlan& plan);
// Only that it does not have too many cells and runs.
std::string check_size(const StudyPlan& plan);

}  // namespace lockstep
