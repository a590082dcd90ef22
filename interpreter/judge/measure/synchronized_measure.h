// The measures of one synchronized node that the summary of a run and `lockstep log info` report.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "judge/measure/fall.h"
#include "judge/measure/held.h"
#include "judge/measure/progress_distance.h"
#include "judge/measure/spread.h"
#include "judge/measure/step_length.h"
#include "judge/measure/synchronized_ticks.h"

namespace lockstep::host {

class SynchronizedMeasure {
 public:
  SynchronizedMeasure(std::size_t children, const Guards& guards, Synchronization synchronization,
                      bool is_group);

  void join(Joint joint) {
    step_length_.join(joint);
    if (joint == Joint::Cut) return;
    falls_.join();
    joins_ = true;
  }
  void after_tick(const SynchronizedTick& tick);
  void run_ended(Nanoseconds time);

  const ProgressDistance& distance() const { return distance_; }
  double largest_spread() const { return spread_.value({}); }
  double step_length() const { return step_length_.value({}); }
  // The spread cannot be larger: what the limits allowed, and the longest step. Nothing if progress
  // fell, or rose while it was held or before the first tick that counts, or a child that was left
  // out may have joined from far behind, or the children were farther apart when the run was
  // joined.
  std::optional<double> bound() const;
  bool is_pool() const { return synchronization_ == Synchronization::Resources; }
  const FallWatch& falls() const { return falls_; }
  std::span<const HeldChild> held() const { return held_; }

 private:
  void see_children(const TickView& view);
  void pass_time_of_held(const TickView& view);

  ProgressDistance distance_;
  Spread spread_;
  StepLength step_length_;
  std::size_t guards_;
  Synchronization synchronization_;
  bool left_out_ = false;  // another child than a guard, in some tick
  double widest_ = 0;      // between the least progress and the farthest that was allowed
  bool joins_ = false;     // with the next tick that counts
  double spread_at_join_ = 0;
  FallWatch falls_;
  std::vector<HeldChild> held_;
};

// A synchronized node, or a pool, and its measures.
struct MeasuredNode {
  SynchronizedTicks ticks;
  SynchronizedMeasure measure;

  void after_tick(const Moment& moment) { measure.after_tick(ticks.read(moment)); }
};

// One for each synchronized node.
std::vector<MeasuredNode> measured_nodes(const Shape& shape);

}  // namespace lockstep::host
