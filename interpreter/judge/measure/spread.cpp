#include "judge/measure/spread.h"

#include <algorithm>

namespace lockstep::host {

void Spread::after_tick(const TickView& view) {
  const SynchronizedTick& tick = view.parallels[place_];
  if (!tick.ticked) return;
  double least = 1, most = 0;
  for (const double one : tick.progress) {  // no comparison is true for one that is left out
    if (one < least) least = one;
    if (one > most) most = one;
  }
  largest_ = std::fmax(largest_, std::max(0.0, most - least));
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
