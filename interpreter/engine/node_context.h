// What a node kind sees of a run: the life cycle of every node (activation, halt, pause, resume),
// once, in one place, and what belongs to its own node. One thread at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/blackboard.h"
#include "engine/bound_parameters.h"
#include "engine/bound_scripts.h"
#include "engine/held_leaves.h"
#include "engine/leaf_slot.h"
#include "engine/named_entries.h"
#include "engine/run_state.h"
#include "engine/tree.h"

namespace lockstep {

// What a fault does to the run.
enum class FaultPolicy : std::uint8_t {
  Stop,  // the run ends
  Fail,  // the leaf's activation ends with Failure; the tree goes on
};

class NodeContext {
 public:
  NodeContext(const NodeContext&) = delete;
  NodeContext& operator=(const NodeContext&) = delete;

  // --- inside a tick -----------------------------------------------------------------------------

  // Ticks a node and keeps its status. At most once per node and tick. After a fault it does
  // nothing, and the control nodes that are in their tick do not complete: all of them stay
  // Running.
  Status tick(NodeIndex node) {
    if (state_.interrupted) [[unlikely]] {
      if (const auto status = tick_interrupted(node)) return *status;
    }
    Activity& activity = state_.activity[node];
    const Node& it = nodes_[node];
    if (has_ended(status_of(activity)) && it.children != 0) forget_descendants(node);
    Status status = it.kind->tick(*this, node);
    if (state_.faulted) [[unlikely]]
      status = Status::Running;
    activity = static_cast<Activity>(status);
    state_.last_tick[node] = state_.tick_number;
    return status;
  }

  // Ticks a child that has completed in this activation of its parent and was not reset: its
  // pre-conditions are not asked, and NodeKind::unreset says what it does.
  Status tick_unreset(NodeIndex node);

  // The tree is ticked again in this period, if the root is Running then.
  void ask_for_another_tick(NodeIndex node) { state_.asked_by = node + 1; }

  // The nodes of a range that were skipped begin again in their next tick.
  void forget_range(NodeIndex first, NodeIndex last) {
    if (tree_.keeps_over_skips) forget_skipped(first, last);
  }

  // Ends the activation of every running node in the subtree; all of it is idle then. After a fault
  // it does nothing.
  void halt(NodeIndex node) { halt_range(node, nodes_[node].end); }
  void halt_range(NodeIndex first, NodeIndex last);
  // Of a node's children, those that run; the others keep their status.
  void halt_running_children(NodeIndex node);

  // True in halt_all: every running leaf is halted, whatever has failed.
  bool in_last_halt() const { return state_.in_last_halt; }

  // Withholds ticks from a subtree: each running leaf gets one `pause`, until it is ticked again.
  void pause(NodeIndex node);
  // The same for a child that is not to be ticked now. False: a leaf in it has failed as a program
  // and the run goes on, so the child gets its tick, in which that leaf is halted and fails.
  bool hold(NodeIndex child) {
    if (activity(child) == Activity::Running) pause(child);
    return state_.failed_leaves.empty() || !has_failed_leaf(child);
  }
  // The same for a child in which nothing may begin: it gets its tick only if it is such a leaf
  // itself. One that is further down is halted, and fails in its next tick.
  bool hold_firmly(NodeIndex child) {
    if (activity(child) == Activity::Running) pause(child);
    return state_.failed_leaves.empty() || !fails_itself(child);
  }

  // In [0, 1]: 1 on Success, 0 when idle or failed.
  double progress(NodeIndex node) {
    const Status now = status(node);
    if (now == Status::Running) return nodes_[node].kind->progress(*this, node);
    return now == Status::Success ? 1.0 : 0.0;
  }

  // True until the node has been Running: the first tick of an activation.
  bool first_tick(NodeIndex node) const { return status(node) != Status::Running; }

  template <class State>
  State& state(NodeIndex node) {
    return *reinterpret_cast<State*>(state_bytes() + nodes_[node].state);
  }
  // What a kind with state_per_child keeps behind its state, one for each child.
  template <class T>
  std::span<T> child_states(NodeIndex node) {
    const Node& it = nodes_[node];
    return {reinterpret_cast<T*>(state_bytes() + it.state + it.kind->state_size), it.children};
  }
  // All that a node keeps in RunState.
  std::span<std::byte> kept_bytes(NodeIndex node) {
    const Node& it = nodes_[node];
    return {state_bytes() + it.state,
            it.kind->state_size + std::size_t{it.children} * it.kind->state_per_child};
  }
  std::span<double> child_numbers(NodeIndex node) { return child_states<double>(node); }
  const Cell& parameter(NodeIndex node, unsigned index) const {
    return parameters_.cells()[nodes_[node].params + index];
  }
  // No entry gives one of its parameters.
  bool has_constant_parameters(NodeIndex node) const { return !nodes_[node].kind->reads_entries; }
  std::span<const double> numbers(const Cell& cell) const {
    return {parameters_.numbers() + cell.list.first, cell.list.count};
  }
  // Ticks a node of Tree::bound with the current values of its entries. A value that the node does
  // not accept is a fault.
  Status tick_bound(NodeIndex node);
  // Ticks a node of Tree::hooked with its scripts.
  Status tick_hooked(NodeIndex node);
  // The same before the node's tick: false without a fault, which is that of its tick.
  bool refresh(NodeIndex node);
  // Of a node that may be bound: reads its entries in the middle of its tick. A value that it does
  // not accept is a fault, and the result is false.
  bool reread(NodeIndex node);
  // After such a fault: the status that the node's tick returns.
  Status give_up(NodeIndex node);

  // Of a list of texts that is a constant.
  std::span<const std::string> texts(NodeIndex node, unsigned index) const {
    const auto constant = static_cast<std::size_t>(parameter(node, index).integer);
    return std::get<std::vector<std::string>>(tree_.constants[constant]);
  }

  // The script that a parameter has; for those below.
  std::uint32_t script(NodeIndex node, unsigned index) const {
    return static_cast<std::uint32_t>(parameter(node, index).integer);
  }
  // Runs a script; none is fine. An error is a fault of the node, which names the attribute, and
  // the result is false, or nothing.
  bool run_script(NodeIndex node, std::uint32_t script, std::string_view attribute);
  std::optional<bool> holds(NodeIndex node, std::uint32_t script, std::string_view attribute);
  // Its value, until another script runs; null after an error. No value is one.
  const Value* result_of(NodeIndex node, std::uint32_t script, std::string_view attribute);

  // What a kind keeps beside its state, until the run begins again.
  Value& kept_value(NodeIndex node) { return state_.kept_values[node]; }
  void drop_kept_value(NodeIndex node) { state_.kept_values.erase(node); }

  // Of a kind that reads ports (NodeType::reads_ports).
  const PortBinding& port(NodeIndex node, unsigned index) const {
    return tree_.ports[nodes_[node].params + index];
  }
  Entry* port_entry(NodeIndex node, unsigned index) {  // null: no {key}
    const std::uint32_t slot = port(node, index).slot;
    return slot == PortBinding::kUnbound ? nullptr : &board_.entries[slot];
  }
  // Null: it has no value.
  const Value* port_value(NodeIndex node, unsigned index) const;
  // Of a port that names an entry (Parameter::is_key), which may not be present. Null: it is none
  // of this tree. Nothing: the name has no value, which is a fault.
  std::optional<Entry*> named_entry(NodeIndex node, unsigned index);
  // Of a tree with boards: what `key` means where the node is; and null if it belongs to an outer
  // tree. Allocates.
  Entry& entry_at(NodeIndex node, std::string_view key) {
    return names_.at(tree_.board_of(node), key);
  }
  Entry* own_entry_at(NodeIndex node, std::string_view key) {
    return names_.own(tree_.board_of(node), key);
  }

  // Of a node whose kind has a parameter that names a group.
  const Member& membership(NodeIndex node) const { return tree_.membership(node); }
  // A member was ticked: its group counts as ticked in this tick.
  void reach(NodeIndex group) { state_.last_tick[group] = state_.tick_number; }
  // Of a group whose common ancestor runs: Success, or Running again.
  void set_complete(NodeIndex group, bool is_complete) {
    state_.activity[group] = is_complete ? Activity::Success : Activity::Running;
  }
  LeafSlot& leaf(NodeIndex node) { return leaves_[nodes_[node].params]; }

  // Under FaultPolicy::Fail the fault is noted in tolerated(), and a leaf's slot is marked failed:
  // its tick, or the next one, returns Failure.
  void set_fault(NodeIndex node, std::string message);
  bool faulted() const { return state_.faulted; }
  // Only the first of each leaf is kept.
  void note_out_of_range(NodeIndex node, double reported);
  // A leaf that is held from now on: whether it goes on is looked at before each tick.
  void watch_held(NodeIndex node) { held_leaves_.add(node, leaf(node)); }

  // --- at any time -------------------------------------------------------------------------------

  const Tree& tree() const { return tree_; }
  const Blackboard& blackboard() const { return board_; }
  const Node& node(NodeIndex node) const { return nodes_[node]; }
  NodeIndex end_of(NodeIndex node) const { return nodes_[node].end; }
  bool is_guard(NodeIndex node) const { return nodes_[node].is_guard != 0; }
  bool is_latched(NodeIndex node) const { return nodes_[node].is_latched != 0; }
  Activity activity(NodeIndex node) const { return state_.activity[node]; }
  Status status(NodeIndex node) const { return status_of(state_.activity[node]); }
  bool held(NodeIndex node) const { return state_.activity[node] == Activity::Paused; }
  bool ticked(NodeIndex node) const {  // in the last tick
    return state_.tick_number != 0 && state_.last_tick[node] == state_.tick_number;
  }
  // Of the last tick; the first is 1.
  std::uint32_t tick_number() const { return state_.tick_number; }
  Nanoseconds now() const { return state_.now; }  // of this tick, since the run began

 protected:
  // `tree`, `leaves` (one for each Tree::leaves, in order) and `board` must outlive this.
  NodeContext(const Tree& tree, std::span<LeafSlot> leaves, Blackboard& board, FaultPolicy policy);
  ~NodeContext() = default;

  std::optional<Status> tick_interrupted(NodeIndex node);
  Status fail(NodeIndex node);
  void reach_groups_in(NodeIndex node);
  Truth ask(NodeIndex node, const HookedNode& hooked, Hook hook);
  std::optional<Status> ask_first(NodeIndex node, const HookedNode& hooked);
  std::optional<Status> ask_while(NodeIndex node, const HookedNode& hooked);
  Status finish(NodeIndex node, const HookedNode& hooked, Status status);
  void fail_script(NodeIndex node, std::string_view attribute, std::string_view wrong);
  void note_halt(NodeIndex node);
  void run_halt_hooks(std::size_t from, NodeIndex before);
  void forget_skipped(NodeIndex first, NodeIndex last);
  void forget_descendants(NodeIndex node);
  NodeIndex end_activation(NodeIndex node);
  void keep_ancestors_running(NodeIndex node);
  void note_failed_leaf(NodeIndex node);
  bool has_failed_leaf(NodeIndex child);
  bool fails_itself(NodeIndex child);
  void halt_failed(NodeIndex node);
  std::uint32_t bound_of(NodeIndex node) const {  // in Tree::bound
    return static_cast<std::uint32_t>(parameters_.cells()[nodes_[node].params - 1].integer);
  }
  std::byte* state_bytes() { return reinterpret_cast<std::byte*>(state_.bytes.data()); }

  const Tree& tree_;
  const Node* const nodes_;  // of the tree
  const std::span<LeafSlot> leaves_;
  Blackboard& board_;
  BoundParameters parameters_;
  RunState state_;
  NamedEntries names_;
  BoundScripts scripts_;
  const FaultPolicy policy_;
  std::vector<NodeIndex> halting_ = {};  // that were halted and have a script for it
  HeldLeaves held_leaves_;
};

}  // namespace lockstep
