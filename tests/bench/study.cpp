// Runs per second of studies on one thread: two stochastic leaves, and the three of Example 5 of
// the paper, both with 10 barriers. From below: the same numbers in a loop without a tree, the
// ticks with nothing around them, measured runs, and the whole study, without a disk, on threads.
#include <benchmark/benchmark.h>

#include "bench/bench_study.h"
#include "study/workers.h"

namespace {

using namespace lockstep::host;

constexpr const char* kExample5 = R"(<root lockstep="1"><BehaviorTree ID="Example5">
  <ParallelAbsolute barrier_count="10">
    <Advance step="0.01" noise="0.01"/>
    <Advance step="0.02" noise="0.01"/>
    <Advance step="0.05" noise="0.01"/>
  </ParallelAbsolute>
</BehaviorTree></root>)";

// Time per tick of the tree.
void count(benchmark::State& state, std::uint64_t ticks, const char* what) {
  state.counters[what] = benchmark::Counter(
      static_cast<double>(ticks), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void without_a_tree(benchmark::State& state) {
  std::uint64_t seed = 0, ticks = 0;
  for (auto _ : state) ticks += two_leaves_without_a_tree(seed++);
  state.SetItemsProcessed(state.iterations());
  count(state, ticks, "per_tick");
}

void ticking_alone(benchmark::State& state, const char* tree) {
  const BenchStudy study(tree);
  Run run(study.cell.tree, {});
  std::uint64_t seed = 0, ticks = 0;
  for (auto _ : state) {
    run.restart(run_seed(0, 0, seed++));
    Nanoseconds now{0};
    for (++ticks; run.tick(now) == Status::Running; ++ticks) now += std::chrono::milliseconds(10);
  }
  state.SetItemsProcessed(state.iterations());
  count(state, ticks, "per_tick");
}

void measured_runs(benchmark::State& state, const char* tree) {
  const BenchStudy study(tree);
  StudyRun run(study.cell, study.measures, 1'000'000, nullptr);
  std::uint64_t seed = 0, ticks = 0;
  for (auto _ : state) ticks += run.run(run_seed(0, 0, seed++)).ticks;
  state.SetItemsProcessed(state.iterations());
  count(state, ticks, "per_tick");
}

void whole_study(benchmark::State& state, const char* tree) {
  const BenchStudy study(tree);
  StudyPlan plan;
  plan.runs = 200'000;
  plan.max_ticks = 1'000'000;
  plan.columns = {{"progress-distance", "parallel"}};
  for (auto _ : state) {
    do_work({.plan = plan,
             .cells = std::span(&study.cell, 1),
             .measures = study.measures,
             .last_row = plan.runs,
             .jobs = static_cast<unsigned>(state.range(0)),
             .stop_signal = nullptr,
             .write = [](std::string_view, std::span<const RowResult>) { return true; },
             .out_of_range = {},
             .idle = {}});
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(plan.runs));
}

BENCHMARK(without_a_tree);
BENCHMARK_CAPTURE(ticking_alone, two_leaves, kTwoLeaves);
BENCHMARK_CAPTURE(measured_runs, two_leaves, kTwoLeaves);
BENCHMARK_CAPTURE(whole_study, two_leaves, kTwoLeaves)->Arg(1)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(whole_study, two_leaves, kTwoLeaves)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(ticking_alone, example5, kExample5);
BENCHMARK_CAPTURE(measured_runs, example5, kExample5);
BENCHMARK_CAPTURE(whole_study, example5, kExample5)->Arg(1)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(whole_study, example5, kExample5)->Arg(2)->UseRealTime();

}  // namespace
