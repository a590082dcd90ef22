// The tree of a run as a document for BehaviorTree.CPP, as Groot2 draws it.
#pragma once

#include <span>
#include <string>

#include "groot/subtrees.h"

namespace lockstep::host {

// Each subtree is a BehaviorTree, and each node has the uid of its status. Nodes that the library
// has too are called as there; TreeNodesModel describes all.
std::string groot_document(const Definition& definition, std::span<const GrootSubtree> subtrees);

}  // namespace lockstep::host
