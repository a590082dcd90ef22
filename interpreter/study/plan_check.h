// Checks the numbers and names of a plan, from the command line or from a study.json.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "study/plan.h"

namespace lockstep::host {

constexpr double kLeastRate = 0.001, kMostRate = 100000;

// Parses a whole number, and a rate, from the whole text.
std::optional<std::uint64_t> count_from(std::string_view text);
std::optional<double> rate_from(std::string_view text);

// A value that is there twice among axes that vary together and have as many values each, with ':'
// between the values of the axes, or "".
std::string value_twice(std::span<const GridAxis> together);

// The error in the plan, or "".
std::string check_plan(const StudyPlan& plan);
// Checks only that it does not have too many cells and runs.
std::string check_size(const StudyPlan& plan);

}  // namespace lockstep::host
