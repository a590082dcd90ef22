// What the recorder costs the tick thread, in nanoseconds per node and tick: of nodes that change
// in every tick, of nodes that run but do not change, and of nodes that nothing happens to. Beside
// it, of the same trees, the tick alone, and the questions for progress alone, which no recorder
// can do without.
#include "record/write/recorder.h"

#include <benchmark/benchmark.h>

#include <chrono>

#include "bench/bench_tree.h"
#include "run/observers.h"
#include "run/run.h"
#include "run/shape_of.h"

namespace {

using namespace lockstep::host;
using SteadyClock = std::chrono::steady_clock;
using Duration = SteadyClock::duration;

// A recorder of a run that ticks as fast as it can. The disk takes everything, but numbers become
// text more slowly than this; so now and then, and not counted, it is waited for.
class Recorded {
 public:
  explicit Recorded(const Tree& tree)
      : run_(tree, {}),
        recorder_(shape_of(tree), {.path = "/dev/null", .run = {.tree_file = "bench.xml"}}),
        observers_(tree, {&watching_, 1}) {
    observers_.run_started(run_.ticker(), {});
  }

  Duration tick() {
    report_.time += std::chrono::milliseconds(1);
    const auto begin = SteadyClock::now();
    observers_.before_tick(run_.ticker(), report_.tick, report_.time);
    const auto asked = SteadyClock::now();
    run_.tick(report_.time);
    const auto ticked = SteadyClock::now();
    observers_.after_tick(run_.ticker(), report_);
    const auto end = SteadyClock::now();
    ++report_.tick;
    return (asked - begin) + (end - ticked);
  }
  // The closing line is one that a run waits for.
  void wait() { observers_.run_ended(run_.ticker(), {}); }
  std::uint64_t lost() const { return recorder_.lost(); }

 private:
  Run run_;
  Recorder recorder_;
  Observer* const watching_ = &recorder_;
  Observers observers_;
  TickReport report_;
};

void set_items(benchmark::State& state, const Tree& tree) {
  const auto nodes = static_cast<std::int64_t>(tree.nodes.size());
  state.SetItemsProcessed(state.iterations() * nodes);
  state.counters["node"] =
      benchmark::Counter(static_cast<double>(nodes), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

void record(benchmark::State& state, const char* control, const char* leaf) {
  const BenchTree bench(control, "", leaf, state.range(0));
  Recorded recorded(bench.tree());
  const std::size_t ticks_in_queue = AppendFile::kQueue / (100 + 20 * bench.tree().nodes.size());
  std::size_t queued = 0;
  for (auto _ : state) {
    state.SetIterationTime(std::chrono::duration<double>(recorded.tick()).count());
    if (++queued < ticks_in_queue) continue;
    recorded.wait();
    queued = 0;
  }
  set_items(state, bench.tree());
  state.counters["lost"] = static_cast<double>(recorded.lost());
}

void tick(benchmark::State& state, const char* control, const char* leaf) {
  const BenchTree bench(control, "", leaf, state.range(0));
  Run run(bench.tree(), {});
  for (auto _ : state) benchmark::DoNotOptimize(run.tick(Nanoseconds(0)));
  set_items(state, bench.tree());
}

void ask(benchmark::State& state, const char* control, const char* leaf) {
  const BenchTree bench(control, "", leaf, state.range(0));
  Run run(bench.tree(), {});
  run.tick(Nanoseconds(0));
  Ticker& ticker = run.ticker();
  for (auto _ : state) {
    for (NodeIndex node = 0; node < bench.tree().nodes.size(); ++node) {
      benchmark::DoNotOptimize(ticker.progress(node));
    }
  }
  set_items(state, bench.tree());
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int leaves : {10, 100, 1000, 10000}) benchmark->Arg(leaves);
}
void recorded_sizes(benchmark::internal::Benchmark* benchmark) {
  sizes(benchmark);
  benchmark->UseManualTime();
}

#define OF_A_TREE(name, control, leaf)                        \
  BENCHMARK_CAPTURE(tick, name, control, leaf)->Apply(sizes); \
  BENCHMARK_CAPTURE(ask, name, control, leaf)->Apply(sizes);  \
  BENCHMARK_CAPTURE(record, name, control, leaf)->Apply(recorded_sizes)

OF_A_TREE(every_node_changes, "Parallel", "BenchAdvance");
OF_A_TREE(all_run_none_changes, "Parallel", "BenchRunning");
OF_A_TREE(all_but_one_are_idle, "Sequence", "BenchRunning");

}  // namespace
