// Runs per second of a study on one thread: Example 5 of the paper with 10 barriers, three leaves
// and about 100 ticks a run, measured; beside it the same ticks with nothing around them. Threads:
// the whole study, without a disk.
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "definition/resolve.h"
#include "engine/compile.h"
#include "measure/measure_spec.h"
#include "plugin/plugin_set.h"
#include "study/workers.h"

namespace {

using namespace lockstep;

constexpr const char* kTree = R"(<root lockstep="1"><BehaviorTree ID="Example5">
  <ParallelAbsolute barrier_count="10">
    <Advance step="0.01" noise="0.01"/>
    <Advance step="0.02" noise="0.01"/>
    <Advance step="0.05" noise="0.01"/>
  </ParallelAbsolute>
</BehaviorTree></root>)";

class Example5 {
 public:
  Example5() {
    Diagnostics diagnostics;
    plugins_.load_file(LOCKSTEP_BENCH_MOTION, diagnostics);
    const auto project = load_project_text("example5.xml", kTree, {}, diagnostics);
    Catalog catalog;
    for (const NodeKind* kind : built_in_kinds()) catalog.add(&kind->type);
    for (const NodeType* type : plugins_.types()) catalog.add(type);
    const auto definition = resolve(*project, catalog, {}, diagnostics);
    if (!definition || !plugins_.initialize(diagnostics)) std::abort();
    cell.tree = compile(*definition);
    cell.columns = {0};
  }

 private:
  PluginSet plugins_;

 public:
  StudyCell cell;
  std::vector<MeasureSpec> measures{parse_measure("progress-distance").value()};
};

// Time per tick of the tree.
void count(benchmark::State& state, std::uint64_t ticks, const char* what) {
  state.counters[what] = benchmark::Counter(
      static_cast<double>(ticks), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void ticking_alone(benchmark::State& state) {
  const Example5 example;
  Run run(example.cell.tree, {});
  std::uint64_t seed = 0, ticks = 0;
  for (auto _ : state) {
    run.restart(run_seed(0, 0, seed++));
    Nanoseconds now{0};
    for (++ticks; run.tick(now) == Status::Running; ++ticks) now += std::chrono::milliseconds(10);
  }
  state.SetItemsProcessed(state.iterations());
  count(state, ticks, "per_tick");
}

void measured_runs(benchmark::State& state) {
  const Example5 example;
  StudyRun run(example.cell, example.measures, 1'000'000, nullptr);
  std::uint64_t seed = 0, ticks = 0;
  for (auto _ : state) ticks += run.run(run_seed(0, 0, seed++)).ticks;
  state.SetItemsProcessed(state.iterations());
  count(state, ticks, "per_tick");
}

void whole_study(benchmark::State& state) {
  const Example5 example;
  StudyPlan plan;
  plan.runs = 200'000;
  plan.max_ticks = 1'000'000;
  plan.columns = {{"progress-distance", "Example5/ParallelAbsolute"}};
  for (auto _ : state) {
    do_work({.plan = plan,
             .cells = std::span(&example.cell, 1),
             .measures = example.measures,
             .last_row = plan.runs,
             .jobs = static_cast<unsigned>(state.range(0)),
             .stop_signal = nullptr,
             .write = [](std::string_view, std::span<const RowResult>) { return true; },
             .idle = {}});
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(plan.runs));
}

BENCHMARK(ticking_alone);
BENCHMARK(measured_runs);
BENCHMARK(whole_study)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
