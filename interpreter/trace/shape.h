// The static shape of a tree, for all that watches, measures, draws and records its runs: plain
// data, made of a compiled tree, or read from the header of a recording, which has it. Example: a
// measure of "Main/lift" means the same node in a live run and in its recording.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/blackboard/entry.h"
#include "base/core/node_type.h"
#include "base/core/value.h"
#include "trace/node_state.h"

namespace lockstep::host {

// What a node asks a person. The text of the question is its reason while it runs.
struct NodeQuestion {
  std::vector<std::string> options = {};
  std::string fallback = {};           // the answer when the time is over; "": none
  std::optional<double> timeout = {};  // s, if it is a constant
  std::string severity = {};           // "info", "warning" or "critical"; "": an entry gives it

  friend bool operator==(const NodeQuestion&, const NodeQuestion&) = default;
};

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
  bool paces = false;                   // it slows what it holds: engine/pace.h
  bool latches = false;                 // a parallel, also one that compares no progress
  bool limits_time = false;             // it fails, and halts its child, after a time
  bool tries_again = false;             // it begins its child again when that fails
  bool holds_first = false;             // only its first child: the others stand for robots
  std::string condition = {};           // of a node that a script decides: its text
  std::vector<std::string> reads = {};  // the keys of the entries in it, as it names them
  // And parameters: "0.5", "{goal}". Null: it has none.
  std::shared_ptr<const std::map<std::string, std::string, std::less<>>> ports = {};
  std::shared_ptr<const NodeQuestion> question = {};  // null: it asks nothing

  // Only of a tree that runs (run/shape_of.h). The header of a recording has none of these.
  const NodeType* type = nullptr;
  bool repeats = false;               // it begins its child again and again: LiveRun::round
  bool first_wins = false;            // a pool where who waits does not get more urgent
  bool keeps_resources = false;       // a user of a pool, as long as its child runs
  std::vector<NodeIndex> gates = {};  // of it: the members of other groups that withhold its ticks

  // These follow from the others: complete.
  std::string segment = {};              // the end of its path
  std::size_t depth = 0;                 // below the root; of a group 0
  std::vector<NodeIndex> children = {};  // a group has none
  std::vector<std::string> names = {};   // of a group: what it calls its members
  std::optional<NodeIndex> keeper = {};  // the last synchronized node that may hold it
  std::optional<NodeIndex> group = {};   // that it is a member of: the node around what that holds
  std::size_t number = 0;                // there
  NodeIndex end = 0;                     // one past the last descendant

  bool is_group() const { return !members.empty() || !resources.empty(); }
  // What it ticks, or may hold.
  const std::vector<NodeIndex>& held() const { return is_group() ? members : children; }
  bool is_pool() const { return synchronization == Synchronization::Resources; }
};

struct ShapeEntry {
  std::string key, type;                // of the blackboard
  std::vector<NodeIndex> writers = {};  // the nodes that may write it
  // Of a tree that runs: what it may hold. Of a recording, only whether that is strict is known.
  ValueType value_type = ValueType::String;
  std::optional<Typing> typing = {};
};

struct Shape {
  std::string id;                        // of the tree
  std::vector<ShapeNode> nodes = {};     // by index: pre-order, then the groups
  std::vector<ShapeEntry> entries = {};  // of a tree: one for each slot; else those that are shown
};

// Computes what follows from the other members of the nodes.
void complete(Shape& shape);

// The nodes that keep others in step, in their order, and the pools.
std::vector<NodeIndex> synchronized_nodes(const Shape& shape);
// The nodes that use resources, those of the first pool first.
std::vector<NodeIndex> users_of_pools(const Shape& shape);
std::vector<bool> resource_users(const Shape& shape);  // the same by index
// Those that begin their child again and again.
std::vector<NodeIndex> repeating_nodes(const Shape& shape);
std::vector<std::string> paths_of(const Shape& shape);
// The node, then those around it.
std::vector<NodeIndex> path_to_root(const Shape& shape, NodeIndex node);
// Whether it stands for another robot of a team.
bool is_robot(const Shape& shape, NodeIndex node);
// The leaf that asks robots for what a member of a pool needs; nothing: they do not share the pool.
std::optional<NodeIndex> asker_of(const Shape& shape, NodeIndex member);
// What a node calls what it holds: the children of a parallel differ in their last segment.
std::vector<std::string> child_names(const Shape& shape, NodeIndex node);

// "arm" of "Main/pull/arm".
std::string last_segment(std::string_view path);
// The ends of these paths, each as short as it can be and still differ from all others.
std::vector<std::string> names_of(std::span<const std::string> paths);

}  // namespace lockstep::host
