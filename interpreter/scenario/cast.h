// Who plays what: the rows of a scenario found in its tree.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "document/reporter.h"
#include "leaves/models.h"
#include "scenario/scenario.h"

namespace lockstep::host {

struct Cast {
  LeafScripts scripts;
  std::set<NodeIndex> real;            // that plugins play themselves
  std::vector<NodeIndex> without_row;  // whose scripts are the usual one, or none
};

// Of rows for which the tree has no leaf.
enum class MissingLeaves : bool { AreErrors, AreLeftOut };

// `has_models`: leaves without a row get no script. Reports errors at their places.
Cast make_cast(const Scenario& scenario, double rate, const Tree& tree, bool has_models,
               MissingLeaves missing, const Reporter& report);

}  // namespace lockstep::host
