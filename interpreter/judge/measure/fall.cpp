#include "judge/measure/fall.h"

namespace lockstep::host {

void FallWatch::after_tick(const SynchronizedTick& tick) {
  if (tick.ticked) {
    for (std::size_t child = 0; child < last_.size(); ++child) see(tick, child);
  }
  end_tick(tick);
}

void FallWatch::note(const SynchronizedTick& tick, std::size_t child) {
  const bool fell = tick.progress[child] < last_[child];
  std::optional<Fall>& first = !runs_            ? rise_before_
                               : !fell           ? rise_while_held_
                               : was_held(child) ? while_held_
                                                 : while_ticked_;
  if (first || (!runs_ && !begins_at_0_)) return;
  first = Fall{child, tick.time};
}

}  // namespace lockstep::host
