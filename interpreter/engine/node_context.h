// NodeContext is a node kind's view of its run: the life cycle of every node (activation, halt,
// pause, resume), once, in one place, and everything that belongs to its own node. One thread at a
// time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/system/fork_guard.h"
#include "engine/bound_parameters.h"
#include "engine/cut.h"
#include "engine/leaf_slot.h"
#include "engine/leaf_watch.h"
#include "engine/moments.h"
#include "engine/pace.h"
#include "engine/run_view.h"
#include "trace/reason.h"

namespace lockstep::host {

class Groups;
class HeldLeaves;
class NodePorts;
class Readings;
class NodeScripts;
class NodeWatch;
class NodeWatches;

// The effect of a fault on the run.
enum class FaultPolicy : std::uint8_t {
  Stop,  // the run ends
  Fail,  // the leaf's activation ends with Failure; the tree goes on
};

class NodeContext : public RunView {
  friend class LeafCall;  // what is around a call of a leaf: engine/leaf_call.h
  friend class LeafLoop;  // the calls of leaves in a loop: engine/leaf_loop.h

 public:
  // --- the life cycle of nodes -------------------------------------------------------------------

  // Ticks a node and keeps its status. At most once per node and tick. After a fault it does
  // nothing, and the control nodes that are in their tick do not complete: all of them stay
  // Running.
  [[gnu::always_inline]] Status tick(NodeIndex node) {
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

  // The same out of line: for a call that is not the usual one.
  Status tick_apart(NodeIndex node);

  // Ticks a child that has completed in this activation of its parent and was not reset: its
  // pre-conditions are not asked, and NodeKind::unreset says what it does.
  Status tick_unreset(NodeIndex node);

  // The tree is ticked again in this period, if the root is Running then.
  void ask_for_another_tick(NodeIndex node) { state_.asked_by = node + 1; }

  // The nodes of a range that were skipped begin again in their next tick.
  void forget_range(NodeIndex first, NodeIndex last);

  // The child is ticked once more in this tick: for a node that does so, before.
  void begin_again(NodeIndex child) {
    if (moments_ != nullptr) [[unlikely]]
      moments_->next(state_, parent_of(child));
  }
  // It was halted in this moment: what it does now would hide that.
  bool was_halted(NodeIndex child) const {
    return moments_ != nullptr && status(child) == Status::Idle && moments_->was_running(child);
  }

  // Ends the activation of every running node in the subtree; all of it is idle then. After a fault
  // it does nothing.
  void halt(NodeIndex node) { halt_range(node, nodes_[node].end); }
  void halt_range(NodeIndex first, NodeIndex last);
  // Halts the children that run; the others keep their status.
  void halt_running_children(NodeIndex node);

  // Of a node whose halt met a fault: the last halt of all reaches it once more, and its script
  // runs then.
  bool is_halted_again(NodeIndex node) const;

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
    if (shares_progress_) [[unlikely]]
      return shared_progress(node);
    return ask_progress(node);
  }

  // That of a node within the tick of one below it, or its own: as if all of them ran and the tick
  // ended here.
  double progress_in_tick(NodeIndex node, NodeIndex below);

  // Until the next tick each node is asked for its progress once, however many ask for it: those
  // who watch, and the nodes above it. Each of those who watch calls it before a tick, at the time
  // of that tick. The first call allocates.
  void share_progress();
  // What it was when it was asked for since the last call of that; 0: it was not.
  double progress_before_tick(NodeIndex node) const;

  // The factor of what is ticked now: engine/pace.h.
  double pace() const { return pace_; }
  // Ticks a child with this factor.
  Status tick_at_pace(NodeIndex child, double given) {
    const double around = std::exchange(pace_, given);
    const Status status = tick(child);
    pace_ = around;
    return status;
  }

  // --- what went wrong ---------------------------------------------------------------------------

  // Under FaultPolicy::Fail the fault is noted in RunState::tolerated, and a leaf's slot is marked
  // failed: its tick, or the next one, returns Failure.
  void set_fault(NodeIndex node, std::string message);
  // A fault in none of the node's calls: of a script around it, of who watches it, of its owner.
  // With `runs` the node keeps the fault until it is halted. Otherwise its next activation begins
  // without it.
  void set_fault_around(NodeIndex node, bool runs, std::string message);
  // Only the first of each leaf is kept.
  void note_out_of_range(NodeIndex node, double reported);
  // The first tick of a leaf that was cut. Running: it begins, as an idle one; else its result.
  Status begin_after_cut(NodeIndex node);
  // The tick is that of a checkpoint on the disk, or no run is kept.
  bool is_durable(std::uint32_t tick) const { return tick <= durable_; }
  // An action with commit="true" has succeeded in this tick.
  void note_commit() { last_commit_ = state_.tick_number; }
  // A leaf that is held from now on: whether it goes on is looked at before each tick.
  void watch_held(NodeIndex node);

  // --- what belongs to a node --------------------------------------------------------------------

  template <class State>
  State& state(NodeIndex node) {
    return *reinterpret_cast<State*>(state_bytes() + nodes_[node].state);
  }
  // The values that a kind with state_per_child keeps behind its state, one for each child.
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
  // The values that some nodes keep beside that, until the run begins again.
  std::unordered_map<NodeIndex, Value>& kept_values() { return state_.kept_values; }
  const Cell& parameter(NodeIndex node, unsigned index) const {
    return parameters_.cells()[nodes_[node].params + index];
  }
  LeafSlot& leaf(NodeIndex node) { return leaves_[nodes_[node].params]; }

  // --- beside the life cycle ---------------------------------------------------------------------

  BoundParameters& parameters() { return parameters_; }
  NodePorts& ports() { return ports_; }                          // of a kind that reads ports
  NodeScripts& scripts() { return scripts_; }                    // of parameters, and around ticks
  Groups& groups() { return groups_; }                           // barriers and pools
  const NodeWatches* watches() const { return watches_.get(); }  // null: nobody watches nodes
  // A leaf has set an error.
  void note_error() { is_usual_.clear(); }
  // A leaf gives the reason of its result in this tick. Allocates with its first one.
  void say(NodeIndex node, LeafSlot& leaf, std::string_view text);
  // The same of a node that is no leaf of a plugin: `place` is its place in reasons(), and 1, or 0.
  void say(NodeIndex node, std::uint32_t& place, std::string_view text);
  // It is still what it was in its last tick. False: it is not known, since another process had it.
  bool say_again(NodeIndex node, std::uint32_t& place);
  // A leaf that has failed as a program, maybe outside of its ticks, returns Failure for that.
  void fail_with_fault(const LeafSlot& leaf);
  // Of the nodes that have ever had one, in the order of their first ones.
  std::span<const Reason> reasons() const { return reasons_; }
  // Tells who watches the node what it returns. Gives that, or what is to be in its place.
  Status tell_result(NodeIndex node, Status status);

 protected:
  // All must outlive this; `leaves` has one for each Tree::leaves, in order. `watch` may be null.
  NodeContext(const Tree& tree, std::span<LeafSlot> leaves, Blackboard& board, FaultPolicy policy,
              LeafWatch* watch);
  ~NodeContext();

  [[gnu::always_inline]] double ask_progress(NodeIndex node) {
    const Status now = status(node);
    if (now == Status::Running) return nodes_[node].kind->progress(*this, node);
    return now == Status::Success ? 1.0 : 0.0;
  }
  double shared_progress(NodeIndex node);

  std::optional<Status> tick_interrupted(NodeIndex node);
  Status fail(NodeIndex node);
  std::uint32_t place_of_reason(NodeIndex node, std::uint32_t known);
  void forget_descendants(NodeIndex node);
  NodeIndex end_activation(NodeIndex node);
  void end_calls_in_line();
  // After a fault of a halt: siblings may still run, so the nodes around them do too.
  void keep_ancestors_running();
  void note_failed_leaf(NodeIndex node);
  void say_fault(NodeIndex node, const std::string& message);
  bool has_failed_leaf(NodeIndex child);
  bool fails_itself(NodeIndex child);
  void halt_failed(NodeIndex node);
  void halt_range_in_moments(NodeIndex first, NodeIndex last);
  void end_range(NodeIndex first, NodeIndex last);
  void keep_results_until(NodeIndex first, NodeIndex last);
  NodeIndex parent_of(NodeIndex node) const;
  std::byte* state_bytes() { return reinterpret_cast<std::byte*>(state_.bytes.data()); }

  const std::span<LeafSlot> leaves_;
  BoundParameters parameters_;
  struct Beside;
  const std::unique_ptr<Beside> beside_;
  NodePorts& ports_;
  NodeScripts& scripts_;
  Groups& groups_;
  HeldLeaves& held_leaves_;
  Readings& readings_;
  const FaultPolicy policy_;
  std::vector<AfterCut> after_cut_;  // of each leaf, for those that were cut
  std::uint32_t durable_ = 0xffffffff, last_commit_ = 0;
  LeafWatch* const watch_;
  LeafWatch* timer_ = nullptr;  // the same while it times each call, else null
  // The mark of the ticking thread, while a leaf is called with nothing around it but this mark and
  // `timer_`; else null.
  CallMark* in_line_ = nullptr;
  // Cleared by what a leaf in line may do that is not the usual: an error, or the end of the calls
  // in line. Also in a forked child.
  ForkGuard::Byte is_usual_;
  std::unique_ptr<NodeWatches> watches_;  // null: nobody has ever watched nodes
  std::unique_ptr<Moments> moments_;      // null: nobody asks for them
  std::vector<Reason> reasons_;
  bool notes_halts_;              // somebody is told of halts: scripts, or who watches
  bool shares_progress_ = false;  // until the next tick
  double pace_ = kNoPace;         // of what is ticked now
};

}  // namespace lockstep::host
