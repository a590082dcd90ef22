// Sees what the leaves of a scenario get at their inputs, against what was expected.
#pragma once

#include <cstdint>
#include <vector>

#include "leaves/play/played_leaves.h"
#include "scenario/bound_scenario.h"
#include "scenario/scenario_runner.h"
#include "trace/observer.h"

namespace lockstep::host {

class InputWatch final : public Observer, public PlayedLeafWatch {
 public:
  // Both must outlive this.
  InputWatch(const BoundScenario& bound, const Tree& tree);

  void before_tick(const Moment&, std::uint64_t tick, Nanoseconds) override { tick_ = tick; }
  void begins(const lockstep_caller& caller) override;

  // After the end. Of each expectation the first surprise.
  std::vector<Surprise> verdict();

 private:
  void compare(std::size_t input, const lockstep_caller& caller);

  const BoundScenario& bound_;
  const Tree& tree_;
  std::uint64_t tick_ = 0;
  std::vector<bool> has_begun_, is_violated_;  // of each input
  std::vector<Surprise> surprises_;
};

}  // namespace lockstep::host
