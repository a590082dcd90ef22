// study.json: everything that is needed to repeat a study, and nothing that differs between
// machines.
#pragma once

#include <string>

#include "base/core/problem.h"
#include "study/plan.h"

namespace lockstep::host {

// Ends with a newline. The same plan gives the same bytes.
std::string to_json(const StudyPlan& plan);

// Accepts only the exact bytes that to_json() gives for a plan that check_plan() accepts.
Result<StudyPlan> plan_from_json(std::string text);

// The first key of study.json in which two plans differ; "" if they are the same study (with
// `with_shard` false: perhaps different parts of it).
std::string first_difference(const StudyPlan& one, const StudyPlan& other, bool with_shard);

}  // namespace lockstep::host
