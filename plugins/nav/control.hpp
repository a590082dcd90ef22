// Control nodes and a decorator for navigation, after those of Nav2
// (https://docs.nav2.org/behavior_trees/overview/nav2_specific_nodes.html). As everywhere in
// lockstep, a node ticks a child at most once in a tick; where Nav2 would tick it again, the second
// tick comes in the next tick of the tree.
#pragma once

#include <lockstep/leaf.hpp>

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

  void start() override;
  Status tick() override;
  double progress() const override { return child_progress(kAction); }

 private:
  static constexpr std::uint32_t kAction = 0, kRecovery = 1;
  Status recover();

  std::int64_t retries_ = 0;
  bool recovering_ = false;
};

class PipelineSequence : public lockstep::Control<> {
 public:
  void start() override { furthest_ = 0; }
  Status tick() override;
  double progress() const override;

 private:
  std::uint32_t furthest_ = 0;  // the last child that was reached in this activation
};

struct RoundRobinPorts : lockstep::Ports {
  Input<bool> wrap_around{this, "wrap_around", "false",
                          "after the last child go on with the first, instead of failing"};
};

class RoundRobin : public lockstep::Control<RoundRobinPorts> {
 public:
  void start() override {
    passed_ = 0;
    skipped_ = 0;
  }
  Status tick() override;
  void halt() override { current_ = 0; }

 private:
  bool is_exhausted() const;

  std::uint32_t current_ = 0;  // stays after a Success, so that the next activation goes on
  std::uint32_t passed_ = 0;   // children that failed or were skipped, in this activation
  std::uint32_t skipped_ = 0;  // of those
};

}  // namespace nav
