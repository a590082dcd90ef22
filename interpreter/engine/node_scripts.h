// The scripts of nodes in one run: those that a kind has as parameters, and those around the ticks
// of any node (Tree::hooked). An error of a script is a fault of its node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/bound_scripts.h"
#include "engine/node_context.h"

namespace lockstep::host {

class NodeScripts {
 public:
  // All must outlive this, and the entries of `board` stay where they are.
  NodeScripts(NodeContext& context, const Tree& tree, Blackboard& board, NamedEntries& names,
              Readings& readings);

  // --- a script that is a parameter (Parameter::is_script) ---------------------------------------

  // None is fine. False after an error.
  bool run(NodeIndex node, unsigned parameter);
  // Whether it is true; nothing after an error.
  std::optional<bool> holds(NodeIndex node, unsigned parameter);
  // Its value, until another script runs; null after an error. No value is one.
  const Value* value_of(NodeIndex node, unsigned parameter);

  // --- scripts around ticks ----------------------------------------------------------------------

  // Null for a node that has none.
  const HookedNode* around(NodeIndex node) const {
    const bool has_any = hooks_ != nullptr && hooks_[node] != HookedNode::kNoScript;
    return has_any ? &hooked_[hooks_[node]] : nullptr;
  }
  // Ticks a node with its scripts.
  Status tick(NodeIndex node);
  // Runs those after the tick that completes a node. Returns its status then.
  Status finish(NodeIndex node, const HookedNode& hooked, Status status);

  // Scripts of halted nodes run from the left, those of children before those of their parent. A
  // halt notes each node that it halts, and runs what is noted since there were `begin`, of
  // subtrees that end before the next node. Only in trees with has_halt_hooks, and where nodes are
  // watched.
  std::size_t halted() const { return halted_.size(); }
  void note_halt(NodeIndex node);
  void run_halted(std::size_t begin, NodeIndex next);

  // From now on with the kinds of nodes that are watched.
  void use(const HookedNode* hooked) { hooked_ = hooked; }

  // As new, for the next run.
  void reset() { scripts_.reset(); }

 private:
  std::uint32_t script(NodeIndex node, unsigned parameter) const;
  std::string_view name(NodeIndex node, unsigned parameter) const;
  void run_halted(NodeIndex node);
  Truth ask(NodeIndex node, const HookedNode& hooked, Hook hook);
  std::optional<Status> ask_first(NodeIndex node, const HookedNode& hooked);
  std::optional<Status> ask_while(NodeIndex node, const HookedNode& hooked);
  void fail(NodeIndex node, std::string_view attribute, std::string_view wrong);

  NodeContext& context_;
  const Tree& tree_;
  const std::uint32_t* const hooks_;  // of the tree; null when no node has scripts
  const HookedNode* hooked_;
  BoundScripts scripts_;
  std::vector<NodeIndex> halted_ = {};  // that have a script for it
};

}  // namespace lockstep::host
