#include "trace/shape.h"

#include <map>
#include <numeric>
#include <set>

#include "base/core/parameter_value.h"
#include "engine/synchronized.h"
#include "engine/tree.h"

namespace lockstep::host {
namespace {

// Whether measures compare the progress of the children.
bool is_measured(const ShapeNode& node) {
  return node.latches || compares_progress(node.synchronization);
}

// The last `segments` of a path; all of it when it has no more.
std::string_view end_of(std::string_view path, std::size_t segments) {
  std::size_t begin = path.size();
  for (std::size_t i = 0; i < segments && begin != std::string_view::npos && begin > 0; ++i) {
    begin = path.rfind('/', begin - 1);
  }
  return begin == std::string_view::npos ? path : path.substr(begin + 1);
}

// "left/…/arm" of "left/Sequence/carry/arm".
std::string without_middle(std::string_view end) {
  const auto first = end.find('/'), last = end.rfind('/');
  if (first == last) return std::string(end);
  return std::string(end.substr(0, first)) + "/…" + std::string(end.substr(last));
}

}  // namespace

Shape shape_of(const Tree& tree) {
  Shape shape{.id = tree.id};
  shape.nodes.resize(tree.nodes.size());
  for (NodeIndex index = 0; index < tree.nodes.size(); ++index) {
    ShapeNode& node = shape.nodes[index];
    const NodeLabel& label = tree.labels[index];
    const bool has_parent = label.parent != index;
    // Not each path from the root down: those of a deep tree are long.
    node.path = (has_parent ? shape.nodes[label.parent].path : tree.id) + "/" + tree.segment(index);
    node.kind = label.type->id;
    node.name = label.name;
    if (has_parent) node.parent = label.parent;
    node.synchronization = synchronization(tree.nodes[index]);
    if (const auto list = barriers(tree, index)) node.barriers.emplace(list->begin(), list->end());
    node.delta = delta(tree, index);
    node.ignores_idle = ignores_idle(tree, index);
    node.latches = label.type->latches;
    if (!tree.is_group(index)) continue;
    node.resources = tree.group(index).resources;
    for_each_child(tree, index, [&](NodeIndex child) { node.members.push_back(child); });
  }
  for (const Slot& slot : tree.slots) {
    shape.entries.push_back({.key = slot.name,
                             .type = std::string(type_name(slot.type, slot.object)),
                             .is_strict = slot.typing == Typing::Strict});
  }
  complete(shape);
  for (const ShapeNode& node : shape.nodes) {
    if (!is_measured(node)) continue;
    for (const NodeIndex child : node.held()) {
      shape.nodes[child].is_guard = tree.nodes[child].is_guard != 0;
    }
  }
  return shape;
}

void complete(Shape& shape) {
  for (NodeIndex index = 0; index < shape.nodes.size(); ++index) {
    ShapeNode& node = shape.nodes[index];
    node.segment = last_segment(node.path);
    if (!node.parent) continue;
    ShapeNode& parent = shape.nodes[*node.parent];  // comes before it
    node.depth = parent.depth + 1;
    parent.children.push_back(index);
  }
  for (NodeIndex index = 0; index < shape.nodes.size(); ++index) {
    ShapeNode& node = shape.nodes[index];
    if (node.synchronization == Synchronization::None) continue;
    if (node.is_group()) node.names = child_names(shape, index);
    for (const NodeIndex child : node.held()) shape.nodes[child].keeper = index;
  }
}

std::vector<NodeIndex> synchronized_nodes(const Shape& shape) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    if (shape.nodes[node].synchronization != Synchronization::None) nodes.push_back(node);
  }
  return nodes;
}

std::vector<bool> resource_users(const Shape& shape) {
  std::vector<bool> users(shape.nodes.size());
  for (const ShapeNode& node : shape.nodes) {
    if (node.synchronization != Synchronization::Resources) continue;
    for (const NodeIndex child : node.members) {
      users[shape.nodes[child].parent.value_or(child)] = true;
    }
  }
  return users;
}

std::vector<std::string> paths_of(const Shape& shape) {
  std::vector<std::string> paths;
  paths.reserve(shape.nodes.size());
  for (const ShapeNode& node : shape.nodes) paths.push_back(node.path);
  return paths;
}

std::vector<std::string> child_names(const Shape& shape, NodeIndex node) {
  std::vector<std::string> names;
  const bool is_group = shape.nodes[node].is_group();
  for (const NodeIndex child : shape.nodes[node].held()) {
    names.push_back(is_group ? shape.nodes[child].path : shape.nodes[child].segment);
  }
  return is_group ? names_of(names) : names;
}

std::string last_segment(std::string_view path) {
  return std::string(path.substr(path.rfind('/') + 1));
}

std::vector<std::string> names_of(std::span<const std::string> paths) {
  std::vector<std::string> names(paths.begin(), paths.end());
  std::vector<std::size_t> open(paths.size());  // those without a name yet
  std::iota(open.begin(), open.end(), 0u);
  for (std::size_t segments = 1; !open.empty(); ++segments) {
    std::map<std::string_view, int> ends;  // how often
    for (const std::string& path : paths) ++ends[end_of(path, segments)];
    std::erase_if(open, [&](std::size_t i) {
      const std::string_view end = end_of(paths[i], segments);
      if (ends.at(end) == 1) names[i] = without_middle(end);
      return ends.at(end) == 1 || end.size() == paths[i].size();
    });
  }
  const std::set<std::string_view> different(names.begin(), names.end());
  return different.size() == names.size() ? names : std::vector(paths.begin(), paths.end());
}

}  // namespace lockstep::host
