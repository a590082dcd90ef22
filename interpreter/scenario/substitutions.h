// The substitution rules of BehaviorTree.CPP, as its programs and Groot2 write them in JSON: as
// rows of a scenario.
#pragma once

#include <string>
#include <vector>

#include "base/core/problem.h"
#include "scenario/scenario.h"

namespace lockstep::host {

struct Substitutions {
  std::vector<BindingRow> rows;
  std::vector<std::string> notes;  // what of them is left out
};

Result<Substitutions> read_substitutions(const std::string& path);

}  // namespace lockstep::host
