// Control nodes for navigation, after those of Nav2
// (https://docs.nav2.org/behavior_trees/overview/nav2_specific_nodes.html). In a tree for
// BehaviorTree.CPP they do what Nav2's do in each tick; tests/nodes/nav_test.cpp has a table of it.
// In lockstep's own language a node ticks a child at most once in a tick; where Nav2 would tick it
// again, the second tick comes in the next tick of the tree.
#pragma once

#include "beginning.hpp"

namespace nav {

struct RecoveryPorts : lockstep::Ports {
  Input<std::int64_t> number_of_retries{this, "number_of_retries",
                                        "1",  "how often the recovery may run in an activation",
                                        "",   at_least(0)};
};

// Two children: an action and its recovery.
class RecoveryNode : public lockstep::Control<RecoveryPorts> {
 public:
  static constexpr std::uint32_t kMinChildren = 2, kMaxChildren = 2;

  Status tick() override;
  void halt() override { forget(); }
  double progress() const override { return child_progress(kAction); }

 private:
  static constexpr std::uint32_t kAction = 0, kRecovery = 1;
  Status finish(Status status);
  void forget();

  const bool may_tick_again_ = is_for_btcpp(language());
  std::int64_t retries_ = 0;  // also of the activation before, if its recovery was skipped
  bool recovers_ = false;
};

class PipelineSequence : public lockstep::Control<> {
 public:
  void start() override { furthest_ = 0; }
  Status tick() override;
  double progress() const override;

 private:
  std::uint32_t furthest_ = 0;  // the last child that has run in this activation
};

// Nav2 until Kilted has no wrap_around, and does what "true" does. Since Lyrical it is "false"
// where the tree leaves it out.
template <bool kWraps>
struct RoundRobinPorts : lockstep::Ports {
  Input<bool> wrap_around{this, "wrap_around", kWraps ? "true" : "false",
                          "after the last child continue with the first, instead of failing"};
};

template <bool kWraps>
class RoundRobin : public lockstep::Control<RoundRobinPorts<kWraps>> {
 public:
  using Status = lockstep::Status;
  Status tick() override;
  void halt() override { current_ = failed_ = 0; }

 private:
  std::uint32_t current_ = 0;  // stays after a Success, so that the next activation continues
  std::uint32_t failed_ = 0;   // in this activation
};

extern template class RoundRobin<true>;
extern template class RoundRobin<false>;

}  // namespace nav
