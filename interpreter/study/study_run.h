// The runs of one cell on one thread, one after the other, as `lockstep run --clock virtual` would
// make each of them: with the loop of run/loop.h, without what a study has no use for.
#pragma once

#include <span>

#include "base/core/deadlines.h"
#include "run/live_moments.h"
#include "run/run.h"
#include "study/run_measures.h"

namespace lockstep::host {

// One tree of the grid, shared by all threads.
struct StudyCell {
  Tree tree;
  double rate = 100;
  std::uint64_t seed = 0;
  std::vector<std::size_t> columns = {};  // of the tree's columns, the place among the plan's
};

class StudyRun {
 public:
  // `stop_signal` may be null; nonzero ends a run, which is then discarded.
  StudyRun(const StudyCell& cell, std::span<const MeasureSpec> measures, std::uint64_t max_ticks,
           int (*stop_signal)());

  RunEnd run(std::uint64_t seed);

  // The values of the last run.
  std::span<const double> values() const { return measures_.values(); }
  const Fault* fault() const { return run_ ? run_->fault() : nullptr; }
  std::span<const OutOfRange> out_of_range() { return run_->ticker().out_of_range(); }

 private:
  void begin(std::uint64_t seed);
  bool may_tick(RunEnd& end) const;
  bool tick(RunEnd& end);

  const StudyCell& cell_;
  const Deadlines deadlines_;
  const std::uint64_t max_ticks_;
  int (*const stop_signal_)();
  LeafWatch watch_{LeafWatchOptions{}};  // names the leaf that crashed; times nothing
  RunMeasures measures_;
  LiveMoments moments_;
  std::optional<Run> run_;
};

}  // namespace lockstep::host
