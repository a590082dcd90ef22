// Tells a program that embeds a run of the ticks of some nodes while they happen. A node that is
// watched has a copy of its kind in this run (NodeWatches), so that other nodes, and other runs,
// pay nothing.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "engine/node.h"
#include "engine/tree.h"

namespace lockstep::host {

// All within the tick, in the thread that ticks.
class NodeWatch {
 public:
  virtual ~NodeWatch() = default;
  // The node is ticked now: no script around it has decided before. A result that is given is that
  // of the node, which is not ticked then.
  virtual std::optional<Status> before_tick(NodeIndex node) = 0;
  // It has this result, also without a tick of its own. One that is given replaces it.
  virtual std::optional<Status> after_tick(NodeIndex node, Status status) = 0;
  // It runs and is halted: before what runs in it, and after that.
  virtual void before_halt(NodeIndex node) = 0;
  virtual void after_halt(NodeIndex node) = 0;
};

// The nodes of a run, with the kinds of those that are watched.
class NodeWatches {
 public:
  explicit NodeWatches(const Tree& tree);
  NodeWatches(const NodeWatches&) = delete;
  NodeWatches& operator=(const NodeWatches&) = delete;

  // These and no others, from now on.
  void watch(std::span<const NodeIndex> nodes, NodeWatch* watch);

  const Node* nodes() const { return nodes_.data(); }
  const HookedNode* hooked() const { return hooked_.data(); }
  bool is_watched(NodeIndex node) const { return nodes_[node].kind != tree_.nodes[node].kind; }
  // The kinds of a watched node: as it is ticked within scripts, and with them.
  const NodeKind& inner_kind(NodeIndex node) const;
  const NodeKind& outer_kind(NodeIndex node) const { return *tree_.nodes[node].kind; }
  NodeWatch* watch() const { return watch_; }

 private:
  bool has_scripts(NodeIndex node) const {
    return !tree_.hooks.empty() && tree_.hooks[node] != HookedNode::kNoScript;
  }
  const NodeKind* copy_of(const NodeKind& kind, Status (*tick)(NodeContext&, NodeIndex));

  struct Copy {
    const NodeKind* from;
    NodeKind kind;
  };

  const Tree& tree_;
  std::vector<Node> nodes_;
  std::vector<HookedNode> hooked_;
  std::deque<Copy> copies_;  // they stay where they are
  NodeWatch* watch_ = nullptr;
};

}  // namespace lockstep::host
