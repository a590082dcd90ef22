// Notes that the progress of a child of a synchronized node fell, and whether it fell or rose while
// it was held; and that it was more than 0 in the first tick of an activation, so that this was not
// the first one: a node has asked for another tick in the same period. What delta and barriers
// promise holds only where no progress falls, and none rises while it is held: then the distance of
// the children is bounded. Where none falls while held and all rise, the node ends.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/core/clock.h"
#include "judge/measure/tick_view.h"

namespace lockstep::host {

class FallWatch {
 public:
  struct Fall {
    std::size_t child = 0;
    Nanoseconds time{0};  // of the tick that found it
  };

  // `begins_at_0`: so do all children in each activation, unlike the members of a group.
  explicit FallWatch(std::size_t children, bool begins_at_0 = true)
      : last_(children), was_held_(children), begins_at_0_(begins_at_0) {}

  // What comes next does not follow on the tick before: a change across it is no fall or rise.
  void join() {
    runs_ = true;
    std::ranges::fill(last_, std::numeric_limits<double>::quiet_NaN());
  }
  void after_tick(const SynchronizedTick& tick);
  // The same in parts, for who goes over the children for more than this: each child, if the node
  // was ticked, then the tick.
  void see(const SynchronizedTick& tick, std::size_t child) {
    const double now = tick.progress[child], last = last_[child];
    const bool differs =
        !runs_ ? now > kRounding
               : now < last - kRounding || (was_held_[child] != 0 && now > last + kRounding);
    if (differs) [[unlikely]]
      note(tick, child);
    last_[child] = now;
    was_held_[child] = tick.held[child];
  }
  void end_tick(const SynchronizedTick& tick) {
    // One that is not ticked and does not run was halted.
    runs_ = (runs_ || tick.ticked) && tick.status == Status::Running;
  }
  // In the last tick that the node got.
  bool was_held(std::size_t child) const { return was_held_[child] != 0; }
  // The first of each kind.
  const std::optional<Fall>& while_ticked() const { return while_ticked_; }
  const std::optional<Fall>& while_held() const { return while_held_; }
  // A held child moved on, or what it reports was late.
  const std::optional<Fall>& rise_while_held() const { return rise_while_held_; }
  const std::optional<Fall>& rise_before() const { return rise_before_; }

 private:
  static constexpr double kRounding = 1e-9;

  void note(const SynchronizedTick& tick, std::size_t child);

  std::vector<double> last_;
  std::vector<std::uint8_t> was_held_;
  bool begins_at_0_;
  bool runs_ = false;
  std::optional<Fall> while_ticked_, while_held_, rise_while_held_, rise_before_;
};

}  // namespace lockstep::host
