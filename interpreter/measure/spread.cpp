#include "measure/spread.h"

#include <algorithm>

namespace lockstep {

void Spread::after_tick(const TickView& view) {
  const SynchronizedTick& tick = view.parallels[place_];
  if (!tick.ticked) return;
  const auto [least, most] = std::ranges::minmax(tick.progress);
  largest_ = std::fmax(largest_, most - least);
}

extern const Measure kSpread{
    .name = "spread",
    .of = MeasureOf::Parallel,
    .axis = "largest spread",
    .doc = "the largest distance, in one tick, between the most and the least advanced child",
    .make = make_accumulator<Spread>,
    .is_possible = is_share};

}  // namespace lockstep
