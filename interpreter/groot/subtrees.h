// The trees of a run as Groot2 sees them: the main tree, and one for each SubTree node.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tree/definition.h"

namespace lockstep::host {

struct GrootSubtree {
  std::string_view id;      // of the BehaviorTree
  std::string path;         // of names down to it, unique; "": the main tree
  std::uint32_t node = 0;   // the SubTree node
  std::uint32_t root = 0;   // the first node inside
  std::uint32_t outer = 0;  // the one that has the SubTree node, in this list

  // As a client asks for its blackboard.
  std::string name() const { return path.empty() ? std::string(id) : path; }
};

// In the order of their nodes; the first is the main tree.
std::vector<GrootSubtree> groot_subtrees(const Definition& definition);

// Visits the nodes of a subtree in pre-order, and not those inside of its SubTrees.
template <class Visit>
void for_each_node(const Definition& definition, const GrootSubtree& subtree, Visit visit) {
  const auto& nodes = definition.nodes;
  for (std::uint32_t node = subtree.root; node < nodes[subtree.root].end;) {
    visit(node);
    const bool is_subtree = nodes[node].type->category == NodeCategory::SubTree;
    node = is_subtree ? nodes[node].end : node + 1;
  }
}

// The value of an attribute of a node as it was written; "" if there is none.
std::string_view written_value(const Definition& definition, const DefinitionNode& node,
                               std::string_view attribute);

}  // namespace lockstep::host
