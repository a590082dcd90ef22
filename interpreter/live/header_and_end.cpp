#include "live/header_and_end.h"

#include "engine/synchronized.h"

namespace lockstep::host {

namespace {

// Whether measures compare the progress of the children.
bool is_measured(const Tree& tree, NodeIndex node) {
  return tree.labels[node].type->latches || compares_progress(synchronization(tree.nodes[node]));
}

}  // namespace

std::vector<RecordedNode> describe(const Tree& tree) {
  std::vector<RecordedNode> nodes(tree.nodes.size());
  for (NodeIndex index = 0; index < nodes.size(); ++index) {
    RecordedNode& node = nodes[index];
    const NodeLabel& label = tree.labels[index];
    node.path = tree.path(index);
    node.kind = label.type->id;
    node.name = label.name;
    if (label.parent != index) node.parent = label.parent;
    node.synchronization = synchronization(tree.nodes[index]);
    if (const auto list = barriers(tree, index)) node.barriers.emplace(list->begin(), list->end());
    node.delta = delta(tree, index);
    node.ignores_idle = ignores_idle(tree, index);
    if (tree.is_group(index)) {
      node.resources = tree.group(index).resources;
      for_each_child(tree, index, [&](NodeIndex child) { node.members.push_back(child); });
    }
    if (!is_measured(tree, index)) continue;
    for_each_child(tree, index, [&](NodeIndex child) {
      nodes[child].is_guard = tree.nodes[child].is_guard != 0;
    });
  }
  return nodes;
}

}  // namespace lockstep::host
