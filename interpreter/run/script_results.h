// A recording has the result that a script of a node gives it as the node's own, though the node
// has not been ticked.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>

#include "base/core/hook.h"
#include "base/core/language.h"
#include "engine/tree.h"
#include "language/expression/expression.h"

namespace lockstep::host {

inline bool has_script(const Tree& tree, NodeIndex node) {
  return !tree.hooks.empty() && tree.hooks[node] != HookedNode::kNoScript;
}

// Whether a script of the tree assigns to an entry. No script does nothing.
inline bool assigns(const Tree& tree, std::uint32_t script, std::uint32_t slot) {
  if (script >= tree.scripts.size() || !tree.scripts[script].code) return false;
  const auto uses = tree.scripts[script].code->uses();
  for (std::size_t name = 0; name < uses.size(); ++name) {
    if (tree.scripts[script].slots[name] == slot && (uses[name].is_assigned || uses[name].is_made))
      return true;
  }
  return false;
}

// The same of any script around the ticks of a node.
inline bool assigns_around(const Tree& tree, NodeIndex node, std::uint32_t slot) {
  if (!has_script(tree, node)) return false;
  const auto& scripts = tree.hooked[tree.hooks[node]].scripts;
  return std::ranges::any_of(scripts, [&](std::uint32_t it) { return assigns(tree, it, slot); });
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

// The script around the ticks of the node that this fault is of; none: it is of the node itself.
inline std::optional<Hook> hook_of_fault(const Tree& tree, NodeIndex node,
                                         std::string_view message) {
  constexpr std::string_view kBegin = "its ";  // as of NodeScripts::fail
  if (!has_script(tree, node) || !message.starts_with(kBegin)) return std::nullopt;
  message.remove_prefix(kBegin.size());
  const auto hook = hook_named(message.substr(0, message.find(':')), *tree.rules);
  const HookedNode& hooked = tree.hooked[tree.hooks[node]];
  const bool is_there = hook && hooked.script(*hook) != HookedNode::kNoScript;
  return is_there ? hook : std::nullopt;
}

// Whether the node assigns to the entry when it is halted.
inline bool is_set_by_halt(const Tree& tree, NodeIndex node, std::uint32_t slot) {
  return has_script(tree, node) &&
         assigns(tree, tree.hooked[tree.hooks[node]].script(Hook::OnHalted), slot);
}

// Whether a script around the ticks of the node that assigns to the entry may have run at the end
// of a tick with that result.
inline bool may_be_set_at_end(const Tree& tree, NodeIndex node, Status status, std::uint32_t slot) {
  if (!has_script(tree, node)) return false;
  const HookedNode& hooked = tree.hooked[tree.hooks[node]];
  const auto sets = [&](Hook hook) { return assigns(tree, hooked.script(hook), slot); };
  const bool is_ended = status == Status::Idle;  // by an ancestor, whatever it did
  return ((is_ended || status == Status::Success) && sets(Hook::OnSuccess)) ||
         ((is_ended || status == Status::Failure) && sets(Hook::OnFailure)) ||
         (is_ended && sets(Hook::OnHalted)) || (status != Status::Running && sets(Hook::Post));
}

}  // namespace lockstep::host
