// The static shape of a tree, for all that watches, measures, draws and records its runs: plain
// data, made of a compiled tree, or read from the header of a recording, which has it. Example: a
// measure of "Main/lift" means the same node in a live run and in its recording.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/node_type.h"
#include "engine/node_kind.h"

namespace lockstep::host {

struct Tree;

struct ShapeNode {
  std::string path, kind, name;
  std::optional<NodeIndex> parent = {};  // none: the root, or a group
  Synchronization synchronization = Synchronization::None;
  std::optional<std::vector<double>> barriers = {};  // Absolute; none: an entry gives them
  std::optional<double> delta = {};                  // Relative; likewise
  std::vector<std::string> resources = {};           // of a pool
  std::vector<NodeIndex> members = {};  // of a group: what these hold, a node below each
  bool ignores_idle = false;            // a group that leaves out who is idle
  bool is_guard = false;                // a child of a parallel, or in a member, without an action
  bool latches = false;                 // a parallel, also one that compares no progress

  // These follow from the others: complete.
  std::string segment = {};              // the end of its path
  std::size_t depth = 0;                 // below the root; of a group 0
  std::vector<NodeIndex> children = {};  // a group has none
  std::vector<std::string> names = {};   // of a group: what it calls its members
  std::optional<NodeIndex> keeper = {};  // the last synchronized node that may hold it

  bool is_group() const { return !members.empty() || !resources.empty(); }
  // What it ticks, or may hold.
  const std::vector<NodeIndex>& held() const { return is_group() ? members : children; }
};

struct ShapeEntry {
  std::string key, type;                // of the blackboard
  std::vector<NodeIndex> writers = {};  // the nodes that may write it; readers leave it out
  bool is_strict = false;               // known to hold values of this type only
};

struct Shape {
  std::string id;                        // of the tree
  std::vector<ShapeNode> nodes = {};     // by index: pre-order, then the groups
  std::vector<ShapeEntry> entries = {};  // of a tree: one for each slot; else those that are shown
};

// With all entries.
Shape shape_of(const Tree& tree);
// Computes what follows from the other members of the nodes.
void complete(Shape& shape);

// The nodes that keep others in step, in their order, and the pools.
std::vector<NodeIndex> synchronized_nodes(const Shape& shape);
// By index: whether the node uses resources of a pool.
std::vector<bool> resource_users(const Shape& shape);
std::vector<std::string> paths_of(const Shape& shape);
// What a node calls what it holds: the children of a parallel differ in their last segment.
std::vector<std::string> child_names(const Shape& shape, NodeIndex node);

// "arm" of "Main/pull/arm".
std::string last_segment(std::string_view path);
// The ends of these paths, each as short as it can be and still differ from all others.
std::vector<std::string> names_of(std::span<const std::string> paths);

}  // namespace lockstep::host
