#include "view/tree_shape.h"

#include <utility>

#include "engine/synchronized.h"
#include "measure/measure_spec.h"
#include "measure/synchronized_measure.h"

namespace lockstep::host {
namespace {

// A parent comes before its children.
void add(TreeShape& shape, ShapeNode node) {
  if (node.parent) {
    ShapeNode& parent = shape.nodes[*node.parent];
    node.depth = parent.depth + 1;
    parent.children.push_back(static_cast<NodeIndex>(shape.nodes.size()));
  }
  shape.nodes.push_back(std::move(node));
}

}  // namespace

// From the root down, without the id of the tree.
std::vector<std::string> paths_of(const TreeShape& shape, const std::vector<NodeIndex>& nodes) {
  std::vector<std::string> paths;
  for (const NodeIndex node : nodes) {
    std::string& path = paths.emplace_back(shape.nodes[node].segment);
    for (auto up = shape.nodes[node].parent; up; up = shape.nodes[*up].parent) {
      path.insert(0, shape.nodes[*up].segment + "/");
    }
  }
  return paths;
}

// Once all nodes are there; `members` are those of a group.
void keep_in_step(TreeShape& shape, NodeIndex node, const std::vector<NodeIndex>& members) {
  ShapeNode& it = shape.nodes[node];
  if (it.synchronization == Synchronization::None) return;
  it.in_step = members.empty() ? it.children : members;
  if (!members.empty()) it.names = names_of(paths_of(shape, members));
  for (const NodeIndex child : it.in_step) shape.nodes[child].keeper = node;
}

// Not by way of paths: those of a deep tree are long.
TreeShape shape_of(const Tree& tree) {
  TreeShape shape{.id = tree.id};
  for (NodeIndex index = 0; index < tree.nodes.size(); ++index) {
    const NodeLabel& label = tree.labels[index];
    ShapeNode node{
        .segment = tree.segment(index), .kind = std::string(label.type->id), .parent = {}};
    if (label.parent != index) node.parent = label.parent;
    node.synchronization = synchronization(tree.nodes[index]);
    if (const auto list = barriers(tree, index)) node.barriers.assign(list->begin(), list->end());
    node.ignores_idle = ignores_idle(tree, index);
    if (tree.is_group(index)) node.resources = tree.group(index).resources;
    add(shape, std::move(node));
  }
  for (NodeIndex index = 0; index < tree.nodes.size(); ++index) {
    const bool is_group = tree.is_group(index);
    keep_in_step(shape, index, is_group ? children_of(tree, index) : std::vector<NodeIndex>());
  }
  for (const Slot& slot : tree.slots) shape.entries.push_back(slot.name);
  return shape;
}

TreeShape shape_of(const RecordingHeader& header) {
  TreeShape shape{.id = header.tree};
  for (const RecordedNode& node : header.nodes) {
    add(shape, {.segment = last_segment(node.path),
                .kind = node.kind,
                .parent = node.parent,
                .synchronization = node.synchronization,
                .resources = node.resources,
                .barriers = node.barriers.value_or(std::vector<double>()),
                .ignores_idle = node.ignores_idle});
  }
  for (NodeIndex index = 0; index < header.nodes.size(); ++index) {
    keep_in_step(shape, index, header.nodes[index].members);
  }
  for (const RecordedKey& entry : header.entries) shape.entries.push_back(entry.key);
  return shape;
}

}  // namespace lockstep::host
