// study.json: all that is needed to make a study again, and nothing that differs from one machine
// to the next.
#pragma once

#include <string>

#include "core/problem.h"
#include "study/plan.h"

namespace lockstep {

// Ends with a newline. The same plan gives the same bytes.
std::string to_json(const StudyPlan& plan);

// Only of what to_json() gives of a plan that check_plan() accepts, byte for byte.
Result<StudyPlan> plan_from_json(std::string text);

// The first thing in which two plans differ, as study.json calls it; "" when they are of one study
// (`with_shard` false: perhaps parts of it).
std::string first_difference(const StudyPlan& one, const StudyPlan& other, bool with_shard);

}  // namespace lockstep
