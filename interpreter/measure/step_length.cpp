#include "measure/step_length.h"

namespace lockstep {

void StepLength::after_tick(const TickView& view) {
  const SynchronizedTick& tick = view.parallels[place_];
  if (tick.ticked) {
    longest_ = std::fmax(longest_, 0);
    for (std::size_t child = 0; child < last_.size(); ++child) {
      const double progress = tick.progress[child];
      if (running_) longest_ = std::fmax(longest_, std::abs(progress - last_[child]));
      // When the parallel has succeeded, each child's last step led to 1.
      if (tick.status == Status::Success) longest_ = std::fmax(longest_, std::abs(1 - progress));
      last_[child] = progress;
    }
  }
  running_ = tick.status == Status::Running;
}

extern const Measure kStepLength{.name = "step-length",
                                 .of = MeasureOf::Parallel,
                                 .axis = "step length",
                                 .doc = "the largest change of a child's progress in one tick",
                                 .make = make_accumulator<StepLength>,
                                 .is_possible = is_share};

}  // namespace lockstep
