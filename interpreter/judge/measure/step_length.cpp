#include "judge/measure/step_length.h"

namespace lockstep::host {

void StepLength::after_tick(const TickView& view) {
  const SynchronizedTick& tick = view.parallels[place_];
  if (tick.ticked) {
    for (std::size_t child = 0; child < last_.size(); ++child) see(tick, child);
  }
  end_tick(tick);
}

extern const Measure kStepLength{
    .name = "step-length",
    .argument = kOneParallel,
    .of = MeasureOf::Parallel,
    .axis = "step length",
    .doc =
        "the largest change of a child's own progress in one tick; a child that succeeds goes to "
        "1, and so does one that fails, is not ticked again, and does not end the parallel; others "
        "stay where they are when the parallel ends",
    .sees_success = true,
    .make = make_accumulator<StepLength>,
    .is_possible = is_share};

}  // namespace lockstep::host
