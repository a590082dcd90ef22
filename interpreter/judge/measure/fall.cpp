#include "judge/measure/fall.h"

namespace lockstep::host {

void FallWatch::after_tick(const SynchronizedTick& tick) {
  constexpr double kRounding = 1e-9;
  if (!tick.ticked) {
    runs_ = runs_ && tick.status == Status::Running;  // else it was halted
    return;
  }
  for (std::size_t child = 0; child < last_.size(); ++child) {
    if (runs_ && tick.progress[child] < last_[child] - kRounding) {
      std::optional<Fall>& first = was_held_[child] ? while_held_ : while_ticked_;
      if (!first) first = Fall{child, tick.time};
    }
    if (runs_ && was_held_[child] && tick.progress[child] > last_[child] + kRounding) {
      if (!rise_while_held_) rise_while_held_ = Fall{child, tick.time};
    }
    if (begins_at_0_ && !runs_ && tick.progress[child] > kRounding && !rise_before_) {
      rise_before_ = Fall{child, tick.time};
    }
    last_[child] = tick.progress[child];
    was_held_[child] = tick.held[child];
  }
  runs_ = tick.status == Status::Running;
}

}  // namespace lockstep::host
