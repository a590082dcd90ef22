// Which nodes have more to tell than a status, and what it is.
#pragma once

#include <vector>

#include "engine/synchronized.h"
#include "engine/ticker.h"

namespace lockstep::host {

// Those that run their child again and again.
inline std::vector<NodeIndex> repeating_nodes(const Tree& tree) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (tree.nodes[node].kind->round != nullptr) nodes.push_back(node);
  }
  return nodes;
}

// Visits the children of a node that compares their progress, each with what it used in its last
// tick; 0 for one that it left out.
template <class Visit>  // (NodeIndex, double)
void each_used_progress(Ticker& ticker, NodeIndex node, Visit visit) {
  const double* used = child_progress(ticker, node).data();
  for_each_child(ticker.tree(), node, [&](NodeIndex child) {
    visit(child, is_left_out(*used) ? 0 : *used);
    ++used;
  });
}

}  // namespace lockstep::host
