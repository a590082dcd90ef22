// How often, and for how long, a synchronized node withheld ticks from one of its children. Counts
// only what this node withheld: while the node itself is held, its children are not counted.
#pragma once

#include <cstdint>

#include "judge/measure/measure.h"

namespace lockstep::host {

class HeldChild : public Accumulator {
 public:
  explicit HeldChild(const MeasureTarget& target) : place_(target.place), child_(target.child) {}

  void reset() override { *this = HeldChild({.place = place_, .child = child_}); }
  void after_tick(const TickView& view) override;
  double value(const EndView&) const override { return of_reached(ticks_); }
  void run_ended(Nanoseconds time) { pass_time(time); }

  // Also the tick in which the node ended.
  std::uint64_t ticks() const { return ticks_; }
  // How often it was paused. Consecutive ticks of the node count once, even if the node itself was
  // held in between.
  std::uint64_t pauses() const { return pauses_; }
  // From a tick in which it is held to the next, or to the end of the run.
  Nanoseconds time() const { return time_; }

 protected:
  double of_reached(std::uint64_t count) const {
    return reached_ ? static_cast<double>(count) : kNoValue;
  }

 private:
  void pass_time(Nanoseconds time);

  std::size_t place_, child_;
  bool reached_ = false;  // the node, by any tick
  bool held_ = false;     // now
  bool paused_ = false;   // also while the node itself is held
  std::uint64_t ticks_ = 0, pauses_ = 0;
  Nanoseconds time_{0}, last_{0};
};

}  // namespace lockstep::host
