#include "study/study_run.h"

#include "runtime/deadlines.h"

namespace lockstep::host {

StudyRun::StudyRun(const StudyCell& cell, std::span<const MeasureSpec> measures,
                   std::uint64_t max_ticks, int (*stop_signal)())
    : cell_(cell),
      options_{.rate = cell.rate,
               .max_ticks = max_ticks,
               .timeout = std::nullopt,
               .stop_signal = stop_signal},
      measures_(cell.tree, measures, cell.rate) {}

RunEnd StudyRun::run(std::uint64_t seed) {
  if (run_) {
    run_->restart(seed);
  } else {
    run_.emplace(cell_.tree, RunOptions{.seed = seed,
                                        .period = deadline_of(1, cell_.rate),
                                        .log = {},
                                        .virtual_time = true,
                                        .watch = &watch_});
  }
  VirtualClock clock;
  return run_loop(*run_, clock, options_, observers_);
}

}  // namespace lockstep::host
