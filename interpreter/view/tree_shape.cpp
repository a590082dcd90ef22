#include "view/tree_shape.h"

#include <utility>

#include "measure/measure_spec.h"

namespace lockstep {
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
    add(shape, std::move(node));
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
                .barriers = node.barriers.value_or(std::vector<double>())});
  }
  for (const RecordedKey& entry : header.entries) shape.entries.push_back(entry.key);
  return shape;
}

}  // namespace lockstep
