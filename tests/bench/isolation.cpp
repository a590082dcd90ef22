// What a tick costs when its leaves live in a process of their own, beside the same leaves in this
// one: microseconds of a tick (p50, p99) and nanoseconds of each leaf's share. Back to back, so
// that both processes are awake; and with a pause between ticks, as in a loop, after which the
// first call has to wake the other process.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <thread>
#include <vector>

#include "base/core/clock.h"
#include "run/run.h"
#include "support/compiled.h"

namespace {

using namespace lockstep::host;

// A Parallel of running leaves.
class IsolatedTree {
 public:
  IsolatedTree(std::int64_t leaves, Isolation isolation) {
    std::string text = "<root lockstep=\"1\"><BehaviorTree ID=\"B\"><Parallel>";
    for (std::int64_t leaf = 0; leaf < leaves; ++leaf) text += "<BenchRunning/>";
    text += "</Parallel></BehaviorTree></root>";
    Diagnostics diagnostics;
    plugins_.set_isolation({.leafhost = LOCKSTEP_BENCH_LEAFHOST});
    const bool works = plugins_.load_file(LOCKSTEP_BENCH_LEAVES, diagnostics, {}, isolation) &&
                       plugins_.initialize(diagnostics);
    if (!works) std::abort();
    tree_ = test::compiled(text, plugins_);
  }
  const Tree& tree() const { return tree_; }

 private:
  PluginSet plugins_;
  Tree tree_;
};

void report(benchmark::State& state, std::vector<Nanoseconds>& times) {
  std::ranges::sort(times);
  const auto quantile = [&](std::size_t percent) {
    return static_cast<double>(times[(times.size() - 1) * percent / 100].count());
  };
  state.counters["p50_us"] = quantile(50) / 1e3;
  state.counters["p99_us"] = quantile(99) / 1e3;
  state.counters["ns_per_leaf"] = quantile(50) / static_cast<double>(state.range(0));
}

void tick(benchmark::State& state, Isolation isolation, Nanoseconds pause) {
  const IsolatedTree tree(state.range(0), isolation);
  Run run(tree.tree(), {});
  WallClock clock;
  std::vector<Nanoseconds> times;
  times.reserve(1u << 20);
  for (auto _ : state) {
    if (pause != Nanoseconds(0)) clock.sleep_until(clock.now() + pause);
    const Nanoseconds before = clock.now();
    benchmark::DoNotOptimize(run.tick(Nanoseconds(0)));
    const Nanoseconds took = clock.now() - before;
    times.push_back(took);
    state.SetIterationTime(to_seconds(took));
  }
  report(state, times);
}

constexpr Nanoseconds kNoPause{0};
constexpr Nanoseconds kPause = std::chrono::milliseconds(1);

#define LOCKSTEP_BENCH_TICK(name, isolation, pause) \
  BENCHMARK_CAPTURE(tick, name, isolation, pause)->Arg(1)->Arg(10)->UseManualTime()

LOCKSTEP_BENCH_TICK(in_process, Isolation::InProcess, kNoPause);
LOCKSTEP_BENCH_TICK(isolated, Isolation::Isolated, kNoPause);
LOCKSTEP_BENCH_TICK(in_process_each_ms, Isolation::InProcess, kPause)->Iterations(1000);
LOCKSTEP_BENCH_TICK(isolated_each_ms, Isolation::Isolated, kPause)->Iterations(1000);

}  // namespace
