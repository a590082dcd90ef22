// Notes that the progress of a child of a synchronized node fell, and whether it fell or rose while
// it was held; and that it was more than 0 in the first tick of an activation, so that this was not
// the first one: a node has asked for another tick in the same period. What delta and barriers
// promise holds only where no progress falls, and none rises while it is held: then the distance of
// the children is bounded. Where none falls while held and all rise, the node ends.
#pragma once

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

  // What comes first is not the first tick of the run.
  void join() { runs_ = true; }
  void after_tick(const SynchronizedTick& tick);
  // The first of each kind.
  const std::optional<Fall>& while_ticked() const { return while_ticked_; }
  const std::optional<Fall>& while_held() const { return while_held_; }
  // A held child moved on, or what it reports was late.
  const std::optional<Fall>& rise_while_held() const { return rise_while_held_; }
  const std::optional<Fall>& rise_before() const { return rise_before_; }

 private:
  std::vector<double> last_;
  std::vector<bool> was_held_;
  bool begins_at_0_;
  bool runs_ = false;
  std::optional<Fall> while_ticked_, while_held_, rise_while_held_, rise_before_;
};

}  // namespace lockstep::host
