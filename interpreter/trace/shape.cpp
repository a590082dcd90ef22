#include "trace/shape.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace lockstep::host {
namespace {

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

void complete(Shape& shape) {
  for (NodeIndex index = 0; index < shape.nodes.size(); ++index) {
    ShapeNode& node = shape.nodes[index];
    node.segment = last_segment(node.path);
    node.end = index + 1;
    if (!node.parent) continue;
    ShapeNode& parent = shape.nodes[*node.parent];  // comes before it
    node.depth = parent.depth + 1;
    parent.children.push_back(index);
  }
  for (NodeIndex index = static_cast<NodeIndex>(shape.nodes.size()); index-- > 0;) {
    const ShapeNode& node = shape.nodes[index];
    if (!node.parent) continue;
    NodeIndex& end = shape.nodes[*node.parent].end;
    end = std::max(end, node.end);
  }
  for (NodeIndex index = 0; index < shape.nodes.size(); ++index) {
    ShapeNode& node = shape.nodes[index];
    if (node.synchronization == Synchronization::None) continue;
    if (node.is_group()) node.names = child_names(shape, index);
    for (const NodeIndex child : node.held()) shape.nodes[child].keeper = index;
    for (std::size_t number = 0; number < node.members.size(); ++number) {
      const auto around = shape.nodes[node.members[number]].parent;
      if (!around) continue;  // of a recording that is wrong
      shape.nodes[*around].group = index;
      shape.nodes[*around].number = number;
    }
  }
}

std::vector<NodeIndex> synchronized_nodes(const Shape& shape) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    if (shape.nodes[node].synchronization != Synchronization::None) nodes.push_back(node);
  }
  return nodes;
}

std::vector<NodeIndex> users_of_pools(const Shape& shape) {
  std::vector<NodeIndex> users;
  for (const ShapeNode& node : shape.nodes) {
    if (!node.is_pool()) continue;
    for (const NodeIndex child : node.members) {
      users.push_back(shape.nodes[child].parent.value_or(child));
    }
  }
  return users;
}

std::vector<bool> resource_users(const Shape& shape) {
  std::vector<bool> users(shape.nodes.size());
  for (const NodeIndex user : users_of_pools(shape)) users[user] = true;
  return users;
}

std::vector<NodeIndex> repeating_nodes(const Shape& shape) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    if (shape.nodes[node].repeats) nodes.push_back(node);
  }
  return nodes;
}

std::vector<NodeIndex> path_to_root(const Shape& shape, NodeIndex node) {
  std::vector<NodeIndex> path{node};
  while (const auto parent = shape.nodes[path.back()].parent) path.push_back(*parent);
  return path;
}

std::vector<std::string> paths_of(const Shape& shape) {
  std::vector<std::string> paths;
  paths.reserve(shape.nodes.size());
  for (const ShapeNode& node : shape.nodes) paths.push_back(node.path);
  return paths;
}

bool is_robot(const Shape& shape, NodeIndex node) {
  const auto parent = shape.nodes[node].parent;
  return parent && shape.nodes[*parent].holds_first && node != *parent + 1;
}

std::optional<NodeIndex> asker_of(const Shape& shape, NodeIndex member) {
  const NodeIndex asker = shape.nodes[member + 1].end;
  return asker < shape.nodes[member].end ? std::optional(asker) : std::nullopt;
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
