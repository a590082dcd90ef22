#include "judge/measure/spread.h"

namespace lockstep::host {

void Spread::after_tick(const TickView& view) {
  const SynchronizedTick& tick = view.parallels[place_];
  if (!tick.ticked) return;
  Extent extent;
  for (const double one : tick.progress) extent.see(one);
  take(extent);
}

extern const Measure kSpread{
    .name = "spread",
    .argument = kOneParallel,
    .of = MeasureOf::Parallel,
    .axis = "largest spread",
    .doc = "the largest distance, in one tick, between the most and the least advanced child",
    .make = make_accumulator<Spread>,
    .is_possible = is_share};

}  // namespace lockstep::host
