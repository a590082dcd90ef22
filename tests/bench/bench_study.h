// A study of one cell, and the same numbers without a tree. Used by the benchmarks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/core/random.h"
#include "judge/measure/measure_spec.h"
#include "study/plan.h"
#include "study/study_run.h"
#include "support/compiled.h"

namespace lockstep::host {

inline constexpr const char* kTwoLeaves = R"(<root lockstep="1"><BehaviorTree ID="TwoLeaves">
  <ParallelAbsolute barrier_count="10">
    <Advance step="0.02" noise="0.02"/>
    <Advance step="0.02" noise="0.02"/>
  </ParallelAbsolute>
</BehaviorTree></root>)";

class BenchStudy {
 public:
  explicit BenchStudy(const char* tree) {
    Diagnostics diagnostics;
    plugins_.load_file(LOCKSTEP_BENCH_MOTION, diagnostics);
    cell.tree = test::compiled(tree, plugins_);
    if (!plugins_.initialize(diagnostics)) std::abort();
    cell.columns = {0};
  }

 private:
  PluginSet plugins_;

 public:
  StudyCell cell;
  std::vector<MeasureSpec> measures{parse_measure("progress-distance").value()};
};

// One run of two leaves with ten barriers as one would write it without a tree: two numbers, their
// limit and their distance. Returns its ticks.
[[gnu::noinline]] inline std::uint64_t two_leaves_without_a_tree(std::uint64_t seed) {
  const std::uint64_t of_run = run_seed(0, 0, seed);
  RandomStream random[] = {{of_run, 1}, {of_run, 2}};
  double progress[] = {0, 0};
  double distance = 0;
  std::uint64_t ticks = 0;
  for (; std::min(progress[0], progress[1]) < 1; ++ticks) {
    const double barrier = (std::floor(std::min(progress[0], progress[1]) * 10 + 1e-9) + 1) / 10;
    distance += std::abs(progress[0] - progress[1]);
    for (int leaf = 0; leaf < 2; ++leaf) {
      if (progress[leaf] >= std::min(barrier, 1.0) - 1e-9) continue;
      const double change = 0.02 + 0.02 * (2 * random[leaf].next_double() - 1);
      progress[leaf] = std::clamp(progress[leaf] + change, 0.0, 1.0);
    }
  }
  asm volatile("" : : "m"(distance));  // it is computed
  return ticks;
}

}  // namespace lockstep::host
