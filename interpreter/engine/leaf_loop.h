// Calls siblings that are next to each other and actions of plugins, in one small loop. Only a mark
// is around each call and, where calls are timed, its time. All else stops the loop, and is done by
// the control node as for any other child. The slots of such siblings are next to each other too.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "engine/leaf_call.h"
#include "engine/tree.h"

namespace lockstep::host {

class LeafLoop {
 public:
  // The child at which a row ends, and its status; Idle: it was not ticked. At the end of the
  // parent's children there is no child.
  struct Stop {
    NodeIndex child;
    Status status;
  };

  // Whether the child is called so at all, if it is ready.
  static bool begins_at(const NodeContext& context, NodeIndex child) {
    return context.nodes_[child].kind == &kPluginAction && context.in_line_ != nullptr;
  }

  // Ticks the children from `child` to `end`, as long as each returns `kGoesOn`. Running: only
  // those that run.
  template <Status kGoesOn>
  [[gnu::always_inline]] static Stop tick(NodeContext& context, NodeIndex child, NodeIndex end) {
    return tick_while<kGoesOn>(context, child, end, Any{});
  }
  // The same of those that run and whose progress, `reached` and the numbers after it, is below a
  // limit. One that is held, and is not, stays held.
  [[gnu::always_inline]] static Stop tick_below(NodeContext& context, NodeIndex child,
                                                NodeIndex end, const double* reached,
                                                double limit) {
    return tick_while<Status::Running>(context, child, end, Below{reached, limit});
  }
  // Stores the progress of those that run, also of one that is held, and lowers `least` to it.
  // Returns the first child of which it does not.
  [[gnu::always_inline]] static NodeIndex read_progress(NodeContext& context, NodeIndex child,
                                                        NodeIndex end, double* progress,
                                                        double& least) {
    if (!begins_at(context, child)) return child;
    return context.timer_ != nullptr ? read_row<true>(context, child, end, progress, least)
                                     : read_row<false>(context, child, end, progress, least);
  }

 private:
  struct Any {
    static constexpr bool kHolds = false;
    bool next() { return true; }
  };
  struct Below {
    static constexpr bool kHolds = true;
    bool next() { return *reached++ < limit; }
    const double* reached;
    const double limit;
  };

  static NodeIndex end_of_row(const NodeContext& context, NodeIndex child, NodeIndex end) {
    if (context.watches_ != nullptr) return end_of_watched_row(context, child, end);
    return std::min(end, child + 1 + context.tree_.leaves[context.nodes_[child].params].followers);
  }
  static NodeIndex end_of_watched_row(const NodeContext& context, NodeIndex child, NodeIndex end) {
    while (++child != end && context.nodes_[child].kind == &kPluginAction) {
    }
    return child;
  }

  // Nothing but the call belongs to the tick.
  static bool is_ready(const Activity& activity, const LeafSlot& leaf) {
    if (leaf.marks == 0) [[likely]]
      return true;
    return leaf.marks == LeafSlot::kStarts && activity == Activity::Running;
  }
  // After a call that was not the usual one.
  template <bool kTimed>
  static bool goes_on(const NodeContext& context) {
    return context.in_line_ != nullptr && (context.timer_ != nullptr) == kTimed;
  }
  // One that has failed as a program is not held.
  template <class While>
  [[gnu::always_inline]] static bool stays_held(Activity before, const LeafSlot& leaf,
                                                While& chosen) {
    return While::kHolds && before == Activity::Paused && !leaf.failed() && !chosen.next();
  }
  // From 0 to 1, but not -0: the bits of such numbers are ordered as the numbers are.
  static bool is_in_range(double progress) {
    return std::bit_cast<std::uint64_t>(progress) <= std::bit_cast<std::uint64_t>(1.0);
  }

  template <Status kGoesOn, class While>
  [[gnu::always_inline]] static Stop tick_while(NodeContext& context, NodeIndex child,
                                                NodeIndex end, While chosen) {
    if (!begins_at(context, child)) return {child, Status::Idle};
    return context.timer_ != nullptr ? tick_row<kGoesOn, true>(context, child, end, chosen)
                                     : tick_row<kGoesOn, false>(context, child, end, chosen);
  }
  template <Status kGoesOn, bool kTimed, class While>
  [[gnu::noinline]] static Stop tick_row(NodeContext& context, NodeIndex child, NodeIndex end,
                                         While chosen);
  template <bool kTimed>
  [[gnu::noinline]] static NodeIndex read_row(NodeContext& context, NodeIndex child, NodeIndex end,
                                              double* progress, double& least);
};

// All pointers go from leaf to leaf together, so that they stay in registers over the calls.
template <Status kGoesOn, bool kTimed, class While>
LeafLoop::Stop LeafLoop::tick_row(NodeContext& context, NodeIndex child, NodeIndex end,
                                  While chosen) {
  constexpr bool kRuns = kGoesOn == Status::Running;
  CallMark& mark = *context.in_line_;
  LeafSlot* leaf = &context.leaf(child);
  Activity* activity = context.state_.activity.data() + child;
  std::uint32_t* last_tick = context.state_.last_tick.data() + child;
  const LeafSlot* const last = leaf + (end_of_row(context, child, end) - child);
  const auto here = [&] {
    return static_cast<NodeIndex>(last_tick - context.state_.last_tick.data());
  };
  const auto pass = [&] {
    ++leaf, ++activity, ++last_tick;
    return leaf != last;
  };
  do {
    if constexpr (!kRuns) {
      if (!is_ready(*activity, *leaf)) break;
    } else if (*activity != Activity::Running) {
      if (stays_held(*activity, *leaf, chosen)) continue;
      break;
    } else if (!chosen.next() || leaf->is_unusual()) {
      break;
    }
    bool is_usual = true;
    const auto result = LeafCall::marked<PluginFunction::Tick, kTimed>(context, mark, *leaf,
                                                                       leaf->type->tick, is_usual);
    // Also an error, a fault, or the end of the calls in line.
    if (!is_usual || result != static_cast<int>(kGoesOn)) [[unlikely]] {
      context.is_usual_.set();
      const Status status = LeafCall::complete(context, here(), *leaf, result);
      if (status != kGoesOn) return {here(), status};
      if (goes_on<kTimed>(context)) continue;
      pass();
      break;
    }
    if constexpr (!kRuns) *activity = static_cast<Activity>(kGoesOn);
    *last_tick = context.state_.tick_number;
  } while (pass());
  return {here(), Status::Idle};
}

// The least number stays in a register over the calls, as its bits.
template <bool kTimed>
NodeIndex LeafLoop::read_row(NodeContext& context, NodeIndex child, NodeIndex end, double* progress,
                             double& least) {
  CallMark& mark = *context.in_line_;
  const LeafSlot* leaf = &context.leaf(child);
  const Activity* activity = context.state_.activity.data() + child;
  const LeafSlot* const last = leaf + (end_of_row(context, child, end) - child);
  auto lowest = std::bit_cast<std::uint64_t>(least);
  const auto here = [&] {
    return static_cast<NodeIndex>(activity - context.state_.activity.data());
  };
  const auto pass = [&] {
    ++leaf, ++activity, ++progress;
    return leaf != last;
  };
  do {
    if (status_of(*activity) != Status::Running || leaf->is_unusual()) break;
    double reported = 0.0;
    bool is_usual = true;
    if (leaf->kept_progress != nullptr) {
      reported = leaf->read_progress();
    } else if (leaf->type->progress == nullptr) {
      break;
    } else {
      reported = LeafCall::marked<PluginFunction::Progress, kTimed>(context, mark, *leaf,
                                                                    leaf->type->progress, is_usual);
    }
    if (!is_usual || !is_in_range(reported)) [[unlikely]] {
      context.is_usual_.set();
      reported = LeafCall::spoiled_progress(context, here(), reported);
      is_usual = false;
    }
    *progress = reported;
    lowest = std::min(lowest, std::bit_cast<std::uint64_t>(reported));
    if (is_usual || goes_on<kTimed>(context)) [[likely]]
      continue;
    pass();
    break;
  } while (pass());
  least = std::bit_cast<double>(lowest);
  return here();
}

}  // namespace lockstep::host
