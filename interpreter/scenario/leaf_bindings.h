// Which leaves of a tree the rows of a scenario are about. Example: <leaf path="Main/lift"> means
// the node 4, whose script it gives.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "language/document/reporter.h"
#include "leaves/models.h"
#include "scenario/scenario.h"
#include "tree/definition.h"

namespace lockstep::host {

struct LeafBindings {
  LeafScripts scripts;
  std::set<NodeIndex> real;            // that plugins play themselves
  std::vector<NodeIndex> without_row;  // whose scripts are the usual one, or none
};

// The leaves of a type, or with a path or this end of it; one of both is "".
std::vector<NodeIndex> find_leaves(const Tree& tree, const std::string& of,
                                   const std::string& path);
// The error for a type or a path that no leaf has, with the nearest one as the hint.
Problem no_such_leaf(const Tree& tree, const std::string& of, const std::string& path);

// Rows for which the tree has no leaf.
enum class MissingLeaves : bool { AreErrors, AreLeftOut };

// `given` are the nodes before the fixture has put stubs in place of them.
// `has_models`: leaves without a row get no script. Reports errors at their places.
LeafBindings bind_leaves(const Scenario& scenario, const Tree& tree, const Definition& given,
                         bool has_models, MissingLeaves missing, const Reporter& report);

}  // namespace lockstep::host
