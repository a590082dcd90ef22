// The attributes of a node in a document for BehaviorTree.CPP: ports, scripts and marks.
#pragma once

#include <vector>

#include "language/document/reporter.h"
#include "tree/check/attributes.h"
#include "tree/check/models.h"
#include "tree/checked_tree.h"

namespace lockstep::host::btcpp {

// Checks the attributes of `node`, whose type and children are known, and appends what they say to
// `trees`.
void read_attributes(const NodeElement& element, const Reporter& report, CheckedNode& node,
                     CheckedTrees& trees);

// The same for a SubTree, whose attributes are remappings. Returns the defaults that the model of
// its tree adds.
std::vector<Attribute> read_subtree_attributes(const NodeElement& element, const Models& models,
                                               const Reporter& report, CheckedNode& node,
                                               CheckedSubTree& subtree, CheckedTrees& trees);

}  // namespace lockstep::host::btcpp
