// The call of a leaf with everything around it: its mark, its time, the floating-point mode. Also
// the call of a plugin's leaf in the loop of its parent, which is the ordinary call with as little
// as possible around it.
#pragma once

#include <bit>
#include <cstdint>

#include "engine/blackboard.h"
#include "engine/node_context.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// Any call, also one that an exception ends and one within another.
class LeafCall {
 public:
  LeafCall(NodeContext& context, NodeIndex node, const LeafSlot& leaf, PluginFunction function)
      : context_(context),
        mark_(CallMark::this_thread()),
        node_(node),
        function_(function),
        around_(mark_.enter(*leaf.site, function)),
        in_line_(std::exchange(context.in_line_, nullptr)),
        in_leaf_(context.board_.lock.get()) {
    if (context.watch_ != nullptr) begun_ = context.watch_->begin(mark_);
  }
  ~LeafCall() {
    mark_.leave(around_);
    if (context_.watch_ != nullptr) {
      const std::uint32_t place = context_.node(node_).params;
      context_.watch_->end(begun_, place, node_, function_, mark_);
    }
    context_.in_line_ = context_.state_.interrupted ? nullptr : in_line_;
  }
  LeafCall(const LeafCall&) = delete;
  LeafCall& operator=(const LeafCall&) = delete;

  // NodeContext::tick of a child, with an action of a plugin in line. For the loops of control
  // nodes over their children.
  [[gnu::always_inline]] static Status tick(NodeContext& context, NodeIndex node) {
    return tick_and_pass(context, node);
  }
  // The same, and `child` is the sibling after it then: of a leaf that is known at once.
  [[gnu::always_inline]] static Status tick_and_pass(NodeContext& context, NodeIndex& child);
  // The same of `child` and the siblings after it, up to `end`, as long as each is an action of a
  // plugin with nothing to be done around its call, and returns `kGoesOn`. Returns the first that
  // is not so, and what it returned; Idle: it was not ticked.
  struct Stop {
    NodeIndex child;
    Status status;
  };
  template <Status kGoesOn>
  [[gnu::noinline]] static Stop tick_row(NodeContext& context, NodeIndex child, NodeIndex end);
  // The usual case of a tick: an action of a plugin that runs. Idle: it is not that, or something
  // is to be done around the call, and nothing was done; else its result, and `child` is the
  // sibling.
  [[gnu::always_inline]] static Status tick_running(NodeContext& context, NodeIndex& child);
  // The same of NodeContext::progress, also of one that is held. False: nothing was done.
  [[gnu::always_inline]] static bool progress_of_running(NodeContext& context, NodeIndex& child,
                                                         double& progress);

  // A call with nothing around it but a mark and its time, for a leaf while can_be_in_line. After
  // an exception, which is a fault then, it returns -1.
  template <PluginFunction kFunction, class Result>
  [[gnu::always_inline]] static Result in_line(NodeContext& context, NodeIndex node,
                                               const LeafSlot& leaf, Result (*function)(void*));
  static bool can_be_in_line(const NodeContext& context) { return context.in_line_ != nullptr; }

 private:
  // Of an action.
  static bool is_result(lockstep_status status) {
    return static_cast<unsigned>(status - LOCKSTEP_RUNNING) < static_cast<unsigned>(kLastStatus);
  }

  // Nothing but the call belongs to the tick of a plugin's action. That tick.
  [[gnu::always_inline]] static bool is_ready(const NodeContext& context, NodeIndex node,
                                              const LeafSlot& leaf);
  [[gnu::always_inline]] static Status tick_ready(NodeContext& context, NodeIndex node,
                                                  LeafSlot& leaf);

  // In nodes/leaf.cpp: what did not go well.
  static Status spoiled_tick(NodeContext& context, NodeIndex node, lockstep_status result);
  static double spoiled_progress(NodeContext& context, NodeIndex node, double reported);
  static void note_exception(NodeContext& context, NodeIndex node);

  NodeContext& context_;
  CallMark& mark_;
  const NodeIndex node_;
  const PluginFunction function_;
  const CallMark::Look around_;
  CallMark* const in_line_;
  LeafWatch::Begun begun_;
  const InLeaf in_leaf_;
};

template <PluginFunction kFunction, class Result>
inline Result LeafCall::in_line(NodeContext& context, NodeIndex node, const LeafSlot& leaf,
                                Result (*function)(void*)) {
  CallMark& mark = *context.in_line_;
  mark.enter_alone(*leaf.site, kFunction);
  Result result = -1;
  try {
    result = function(leaf.self);
  } catch (...) {
    note_exception(context, node);
  }
  mark.leave();
  if (context.timer_ != nullptr) {
    context.timer_->note(context.node(node).params, node, kFunction, mark);
  }
  return result;
}

inline Status LeafCall::tick_running(NodeContext& context, NodeIndex& child) {
  const NodeIndex node = child;
  if (context.state_.activity[node] != Activity::Running) return Status::Idle;
  const Node& it = context.nodes_[node];
  if (it.kind != &kPluginAction || context.in_line_ == nullptr) return Status::Idle;
  LeafSlot& leaf = context.leaves_.data()[it.params];
  if (leaf.failed) return Status::Idle;
  ++child;
  const lockstep_status result =
      in_line<PluginFunction::Tick>(context, node, leaf, leaf.type->tick);
  if (result != LOCKSTEP_RUNNING || leaf.error != nullptr) {
    if (leaf.error != nullptr || !is_result(result)) return spoiled_tick(context, node, result);
    context.state_.activity[node] = static_cast<Activity>(result);
  }
  context.state_.last_tick[node] = context.state_.tick_number;
  return static_cast<Status>(result);
}

inline bool LeafCall::progress_of_running(NodeContext& context, NodeIndex& child,
                                          double& progress) {
  const NodeIndex node = child;
  const Node& it = context.nodes_[node];
  if (it.kind != &kPluginAction || context.first_tick(node)) return false;
  const LeafSlot& leaf = context.leaves_.data()[it.params];
  double reported = 0.0;
  if (leaf.failed) return false;
  if (leaf.kept_progress != nullptr) {
    reported = leaf.read_progress();
  } else if (leaf.type->progress == nullptr || context.in_line_ == nullptr) {
    return false;
  } else {
    reported = in_line<PluginFunction::Progress>(context, node, leaf, leaf.type->progress);
  }
  ++child;
  // From 0 to 1, but not -0: the bits of such numbers are ordered as the numbers are.
  const bool is_usual = std::bit_cast<std::uint64_t>(reported) <= std::bit_cast<std::uint64_t>(1.0);
  progress =
      leaf.error == nullptr && is_usual ? reported : spoiled_progress(context, node, reported);
  return true;
}

inline bool LeafCall::is_ready(const NodeContext& context, NodeIndex node, const LeafSlot& leaf) {
  const Activity before = context.state_.activity[node];
  const bool is_simple =
      before == Activity::Running || (before != Activity::Paused && leaf.type->start == nullptr);
  return is_simple && !leaf.failed && !leaf.unreset;
}

inline Status LeafCall::tick_ready(NodeContext& context, NodeIndex node, LeafSlot& leaf) {
  leaf.started = true;
  const lockstep_status result =
      in_line<PluginFunction::Tick>(context, node, leaf, leaf.type->tick);
  if (leaf.error != nullptr || !is_result(result)) [[unlikely]]
    return spoiled_tick(context, node, result);
  context.state_.activity[node] = static_cast<Activity>(result);
  context.state_.last_tick[node] = context.state_.tick_number;
  return static_cast<Status>(result);
}

inline Status LeafCall::tick_and_pass(NodeContext& context, NodeIndex& child) {
  const NodeIndex node = child;
  const Node& it = context.nodes_[node];
  if (it.kind != &kPluginAction || context.in_line_ == nullptr) {
    child = it.end;
    return context.tick(node);
  }
  ++child;
  LeafSlot& leaf = context.leaves_.data()[it.params];
  return is_ready(context, node, leaf) ? tick_ready(context, node, leaf) : context.tick_apart(node);
}

template <Status kGoesOn>
LeafCall::Stop LeafCall::tick_row(NodeContext& context, NodeIndex child, NodeIndex end) {
  for (; child != end; ++child) {
    const Node& it = context.nodes_[child];
    if (it.kind != &kPluginAction || context.in_line_ == nullptr) break;
    LeafSlot& leaf = context.leaves_.data()[it.params];
    if (!is_ready(context, child, leaf)) break;
    const Status status = tick_ready(context, child, leaf);
    if (status != kGoesOn) return {child, status};
  }
  return {child, Status::Idle};
}

}  // namespace lockstep::host
