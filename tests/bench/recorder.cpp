// What the recorder costs the tick thread, in nanoseconds per node and tick: of nodes that change
// in every tick, of nodes that run but do not change, and of nodes that nothing happens to.
#include "observers/recorder.h"

#include <benchmark/benchmark.h>

#include <chrono>

#include "bench/bench_tree.h"
#include "runtime/run.h"

namespace {

using namespace lockstep;

void record(benchmark::State& state, const char* control, const char* leaf) {
  using Clock = std::chrono::steady_clock;
  const BenchTree bench(control, "", leaf, state.range(0));
  Run run(bench.tree(), {});
  Recorder recorder(bench.tree(), {.path = "/dev/null", .tree_file = "bench.xml"});
  recorder.run_started(run.ticker(), {});
  TickReport report;
  for (auto _ : state) {
    report.time += std::chrono::milliseconds(1);
    const auto begin = Clock::now();
    recorder.before_tick(run.ticker(), report.tick, report.time);
    const auto ticked = Clock::now();
    run.tick(report.time);
    const auto resumed = Clock::now();
    recorder.after_tick(run.ticker(), report);
    ++report.tick;
    state.SetIterationTime(
        std::chrono::duration<double>((ticked - begin) + (Clock::now() - resumed)).count());
  }
  state.SetItemsProcessed(state.iterations() * (state.range(0) + 1));
  state.counters["lost"] = static_cast<double>(recorder.lost());
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int leaves : {10, 100, 1000, 10000}) benchmark->Arg(leaves)->UseManualTime();
}

BENCHMARK_CAPTURE(record, every_node_changes, "Parallel", "BenchAdvance")->Apply(sizes);
BENCHMARK_CAPTURE(record, all_run_none_changes, "Parallel", "BenchRunning")->Apply(sizes);
BENCHMARK_CAPTURE(record, all_but_one_are_idle, "Sequence", "BenchRunning")->Apply(sizes);

}  // namespace
