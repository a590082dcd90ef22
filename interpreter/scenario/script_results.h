// A recording has the result that a script of a node gives it as the node's own, though the node
// has not been ticked.
#pragma once

#include "engine/tree.h"

namespace lockstep::host {

inline bool has_script(const Tree& tree, NodeIndex node) {
  return !tree.hooks.empty() && tree.hooks[node] != HookedNode::kNoScript;
}

// Whether a script around its ticks can have given the node this result; `begins`: it was not
// running. Then it is taken for the script's: what the leaf itself did cannot be told from it.
inline bool may_be_of_script(const Tree& tree, NodeIndex node, Status status, bool begins) {
  if (!has_script(tree, node)) return false;
  const HookedNode& hooked = tree.hooked[tree.hooks[node]];
  const auto has = [&](Hook hook) { return hooked.script(hook) != HookedNode::kNoScript; };
  if (status == Status::Skipped) return has(Hook::While) || (begins && has(Hook::SkipIf));
  if (status == Status::Failure) return begins && has(Hook::FailureIf);
  return status == Status::Success && begins && has(Hook::SuccessIf);
}

}  // namespace lockstep::host
