// Nanoseconds per node of a tick, beside the floor: as many calls through a table of function
// pointers. The leaves are in real shared objects. Then a whole tick under each observer.
#include <benchmark/benchmark.h>
#include <dlfcn.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>

#include "bench/bench_tree.h"
#include "groot/publisher.h"
#include "judge/summary/statistics.h"
#include "record/write/recorder.h"
#include "run/observers.h"
#include "run/run.h"
#include "run/shape_of.h"
#include "show/view/console_live.h"
#include "show/web/monitor.h"

namespace {

using namespace lockstep::host;

// As many calls into the same shared object, and nothing else.
class FloorOfCalls {
 public:
  explicit FloorOfCalls(std::size_t calls) {
    void* library = dlopen(LOCKSTEP_BENCH_LEAVES, RTLD_NOW);
    const auto& plugin =
        *static_cast<const lockstep_plugin*>(dlsym(library, LOCKSTEP_PLUGIN_ENTRY));
    table_.assign(calls, plugin.leaf_types[0]);
    benchmark::DoNotOptimize(table_.data());
  }
  void call() const {
    for (const lockstep_leaf_type* type : table_) benchmark::DoNotOptimize(type->tick(nullptr));
  }

 private:
  std::vector<const lockstep_leaf_type*> table_;
};

// Of the processor, for this thread: so what else the machine does counts less.
double seconds_so_far() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
double seconds_of(std::size_t times, const auto& action) {
  const double begin = seconds_so_far();
  for (std::size_t i = 0; i < times; ++i) action();
  return seconds_so_far() - begin;
}

// How many of those calls a node of a tick is worth. The speed of a machine changes within a
// second, so ticks and calls take turns; the fastest of each count.
double in_floors(Run& run, std::size_t nodes) {
  constexpr std::size_t kCalls = 1000, kTurns = 2000;
  const FloorOfCalls calls(nodes);
  const std::size_t times = std::max<std::size_t>(1, kCalls / nodes);
  const std::size_t turns = std::max<std::size_t>(20, kTurns * kCalls / (nodes * times));
  double ticks = 1e9, floor = 1e9;
  for (std::size_t turn = 0; turn < turns; ++turn) {
    ticks = std::min(
        ticks, seconds_of(times, [&] { benchmark::DoNotOptimize(run.tick(Nanoseconds(0))); }));
    floor = std::min(floor, seconds_of(times, [&] { calls.call(); }));
  }
  return ticks / floor;
}

// One item is one node.
void set_items(benchmark::State& state, const BenchTree& bench) {
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(bench.tree().nodes.size()));
}

// Ticks the whole tree; `floors` says what a node costs.
void tick_all(benchmark::State& state, const BenchTree& bench, LeafWatch* watch = nullptr) {
  Run run(bench.tree(), {.watch = watch});
  for (auto _ : state) benchmark::DoNotOptimize(run.tick(Nanoseconds(0)));
  set_items(state, bench);
  state.counters["floors"] = in_floors(run, bench.tree().nodes.size());
}

void flat(benchmark::State& state, const char* control, const char* attributes, const char* leaf) {
  tick_all(state, BenchTree(control, attributes, leaf, state.range(0)));
}

void floor_of_calls(benchmark::State& state) {
  const FloorOfCalls calls(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) calls.call();
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int leaves : {10, 100, 1000, 10000, 100000}) benchmark->Arg(leaves);
}

BENCHMARK(floor_of_calls)->Apply(sizes);
BENCHMARK_CAPTURE(flat, sequence, "Sequence", "", "BenchSuccess")->Apply(sizes);
BENCHMARK_CAPTURE(flat, sequence_of_a_plugin, "SdkSequence", "", "BenchSuccess")->Apply(sizes);
BENCHMARK_CAPTURE(flat, fallback, "Fallback", "", "BenchFailure")->Apply(sizes);
BENCHMARK_CAPTURE(flat, parallel, "Parallel", "", "BenchRunning")->Apply(sizes);
BENCHMARK_CAPTURE(flat, parallel_advance, "Parallel", "", "BenchAdvance")->Apply(sizes);
BENCHMARK_CAPTURE(flat, absolute, "ParallelAbsolute", "barriers='0.75'", "BenchRunning")
    ->Apply(sizes);
BENCHMARK_CAPTURE(flat, absolute_advance, "ParallelAbsolute", "barrier_count='10'", "BenchAdvance")
    ->Apply(sizes);
BENCHMARK_CAPTURE(flat, absolute_kept, "ParallelAbsolute", "barriers='0.75'", "SdkKeeps")
    ->Apply(sizes);
BENCHMARK_CAPTURE(flat, relative_kept, "ParallelRelative", "delta='0.1'", "SdkKeeps")->Apply(sizes);
BENCHMARK_CAPTURE(flat, relative, "ParallelRelative", "delta='0.1'", "BenchRunning")->Apply(sizes);
BENCHMARK_CAPTURE(flat, two_constants, "Parallel", "", "SdkTwo a='1.5' b='2.5'")->Apply(sizes);
BENCHMARK_CAPTURE(flat, relative_advance, "ParallelRelative", "delta='0.1'", "BenchAdvance")
    ->Apply(sizes);

// --- what a leaf is, under a Sequence of 1000 ----------------------------------------------------

constexpr int kLeaves = 1000;

void leaf_kind(benchmark::State& state, const char* leaf) {
  tick_all(state, BenchTree("Sequence", "", leaf, kLeaves));
}
BENCHMARK_CAPTURE(leaf_kind, built_in, "AlwaysSuccess");
BENCHMARK_CAPTURE(leaf_kind, shared_object, "BenchSuccess");
BENCHMARK_CAPTURE(leaf_kind, cpp_sdk, "SdkSuccess");
BENCHMARK_CAPTURE(leaf_kind, btcpp, "BtSuccess");
BENCHMARK_CAPTURE(leaf_kind, cpp_sdk_reads, "SdkRead a='1.5'");
BENCHMARK_CAPTURE(leaf_kind, btcpp_reads, "BtRead a='1.5'");

void ports_read(benchmark::State& state) {
  const auto leaf = fmt::format("<BenchRead reads='{}' a='{{x}}' b='{{y}}'/>", state.range(0));
  tick_all(state,
           BenchTree(fmt::format("<Sequence>{}</Sequence>", BenchTree::repeated(leaf, kLeaves))));
}
BENCHMARK(ports_read)->Arg(0)->Arg(1)->Arg(4);

void script(benchmark::State& state, const char* attribute) {
  const auto leaf = fmt::format("<BenchSuccess {}/>", attribute);
  tick_all(state, BenchTree(fmt::format("<Sequence><Script code='n := 1; m := 1'/>{}</Sequence>",
                                        BenchTree::repeated(leaf, kLeaves))));
}
BENCHMARK_CAPTURE(script, none, "");
BENCHMARK_CAPTURE(script, skip_if, "skip_if='n &gt; 5'");
BENCHMARK_CAPTURE(script, skips, "skip_if='n &gt; 0'");
BENCHMARK_CAPTURE(script, holds, "while='n &lt; 5 &amp;&amp; m == 1'");
BENCHMARK_CAPTURE(script, on_success, "on_success='n = n + 1'");

// --- a run is made, and freed --------------------------------------------------------------------

void start(benchmark::State& state, const char* leaf) {
  const BenchTree bench("Parallel", "", leaf, state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(Run(bench.tree(), {}));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK_CAPTURE(start, no_port, "SdkKeeps")->Arg(1000)->Arg(1'000'000);
BENCHMARK_CAPTURE(start, two_constants, "SdkTwo a='1.5' b='2.5'")->Arg(1000)->Arg(1'000'000);

// --- the shape of the tree -----------------------------------------------------------------------

std::string binary(int depth) {
  if (depth == 0) return "<BenchSuccess/>";
  const std::string child = binary(depth - 1);
  return depth % 2 == 0 ? "<Sequence>" + child + child + "</Sequence>"
                        : "<Fallback><BenchFailure/>" + child + "</Fallback>";
}
void binary_tree(benchmark::State& state) {
  tick_all(state, BenchTree(binary(static_cast<int>(state.range(0)))));
}
BENCHMARK(binary_tree)->Arg(10)->Arg(20);

void chain(benchmark::State& state, const char* open, const char* close) {
  const auto depth = state.range(0);
  tick_all(state, BenchTree(BenchTree::repeated(open, depth) + "<BenchRunning/>" +
                            BenchTree::repeated(close, depth)));
}
BENCHMARK_CAPTURE(chain, decorators, "<Inverter>", "</Inverter>")->Arg(50);
BENCHMARK_CAPTURE(chain, absolute, "<ParallelAbsolute barriers='0.75'><BenchRunning/>",
                  "</ParallelAbsolute>")
    ->Arg(10);
BENCHMARK_CAPTURE(chain, relative, "<ParallelRelative delta='0.5'><BenchRunning/>",
                  "</ParallelRelative>")
    ->Arg(10);

// --- cost follows activity: the time of a whole tick, which must not grow with N -----------------

void tick_time(benchmark::State& state, const std::string& node) {
  const BenchTree bench(node);
  Run run(bench.tree(), {});
  run.tick(Nanoseconds(0));
  for (auto _ : state) benchmark::DoNotOptimize(run.tick(Nanoseconds(0)));
}
void waits_in_last_child(benchmark::State& state) {
  tick_time(state, fmt::format("<Sequence memory='true'>{}<BenchRunning/></Sequence>",
                               BenchTree::repeated("<BenchSuccess/>", state.range(0))));
}
void beside_idle_subtree(benchmark::State& state) {
  tick_time(state, fmt::format("<Fallback><BenchSuccess/><Sequence>{}</Sequence></Fallback>",
                               BenchTree::repeated("<BenchSuccess/>", state.range(0))));
}
// In every tick a subtree is halted, of which one leaf runs.
void halts_one_leaf(benchmark::State& state) {
  tick_time(state, fmt::format("<KeepRunningUntilFailure><Parallel success_count='1'>"
                               "<BenchSuccess/><Sequence><BenchRunning/><Sequence>{}</Sequence>"
                               "</Sequence></Parallel></KeepRunningUntilFailure>",
                               BenchTree::repeated("<BenchSuccess/>", state.range(0))));
}
void activity(benchmark::internal::Benchmark* benchmark) {
  for (const int leaves : {10, 10000, 900000}) benchmark->Arg(leaves);
}
BENCHMARK(waits_in_last_child)->Apply(activity);
BENCHMARK(beside_idle_subtree)->Apply(activity);
BENCHMARK(halts_one_leaf)->Apply(activity);

// --- who watches ---------------------------------------------------------------------------------

// All of a tick under an observer, as the loop does it, of 1000 leaves that run. The queue of a
// recorder, whose lines become text more slowly than this ticks, is waited for now and then; that
// is not counted.
class Observed {
 public:
  Observed(const Tree& tree, Observer* observer)
      : run_(tree, {}), observers_(tree, {&observer, observer == nullptr ? 0u : 1u}) {
    observers_.run_started(run_.ticker(), {});
  }
  void tick() {
    report_.time += std::chrono::milliseconds(1);
    run_.set_now(report_.time);
    observers_.before_tick(run_.ticker(), report_.tick, report_.time);
    report_.status = run_.tick(report_.time);
    observers_.after_tick(run_.ticker(), report_);
    ++report_.tick;
  }
  // The last line of a recording is one that a run waits for.
  void end() { observers_.run_ended(run_.ticker(), {}); }

 private:
  Run run_;
  Observers observers_;
  TickReport report_;
};

// Under the root so many leaves advance; the others stand still.
BenchTree with_changes(const char* control, const char* attributes, std::int64_t leaves) {
  return BenchTree(fmt::format("<{0} {1}>{2}{3}</{0}>", control, attributes,
                               BenchTree::repeated("<BenchAdvance/>", leaves),
                               BenchTree::repeated("<BenchRunning/>", kLeaves - leaves)));
}

void observe(benchmark::State& state, const BenchTree& bench, Observer* observer,
             const std::function<void()>& emptied = {}) {
  constexpr int kTicks = 400;  // whose changes are in a queue at once
  Observed observed(bench.tree(), observer);
  int ticks = 0;
  for (auto _ : state) {
    observed.tick();
    if (!emptied || ++ticks < kTicks) continue;
    state.PauseTiming();
    observed.end();
    emptied();
    ticks = 0;
    state.ResumeTiming();
  }
  set_items(state, bench);
  observed.end();
}

void observed_by_nobody(benchmark::State& state, const char* control, const char* attributes) {
  observe(state, with_changes(control, attributes, state.range(0)), nullptr);
}
void observed_by_statistics(benchmark::State& state, const char* control, const char* attributes) {
  const BenchTree bench = with_changes(control, attributes, state.range(0));
  Statistics statistics(shape_of(bench.tree()));
  observe(state, bench, &statistics);
}
void observed_by_recorder(benchmark::State& state, const char* control, const char* attributes) {
  const BenchTree bench = with_changes(control, attributes, state.range(0));
  const std::string path = std::filesystem::temp_directory_path() / "lockstep_bench_tick.jsonl";
  {
    Recorder recorder(shape_of(bench.tree()), {.path = path, .run = {.tree_file = "bench.xml"}});
    observe(state, bench, &recorder, [&] { std::filesystem::resize_file(path, 0); });
    state.counters["lost"] = static_cast<double>(recorder.lost());
  }
  std::filesystem::remove(path);
}
void observed_by_live_view(benchmark::State& state, const char* control, const char* attributes) {
  const BenchTree bench = with_changes(control, attributes, state.range(0));
  std::FILE* const null = std::fopen("/dev/null", "w");
  {
    Outlet out(fileno(null));
    const Outlet::Thread thread(out);
    ConsoleLive view(shape_of(bench.tree()), {}, out);
    observe(state, bench, &view);
  }
  std::fclose(null);
}
// The feed, and the thread that takes its lines; nobody watches.
void observed_by_monitor(benchmark::State& state, const char* control, const char* attributes) {
  const BenchTree bench = with_changes(control, attributes, state.range(0));
  auto socket = listen_on(kAnyLoopback);
  if (!socket) std::abort();
  Monitor monitor(shape_of(bench.tree()), {.run = {.tree_file = "bench.xml", .rate_hz = 1000}});
  monitor.open(std::move(*socket));
  observe(state, bench, &monitor);
}
// Likewise for Groot2.
void observed_by_groot(benchmark::State& state, const char* control, const char* attributes) {
  const BenchTree bench = with_changes(control, attributes, state.range(0));
  auto requests = listen_on(kAnyLoopback), events = listen_on(kAnyLoopback);
  if (!requests || !events) std::abort();
  GrootTree shown{.document = {}, .order = {}, .boards = {{.name = "B"}}};
  for (NodeIndex node = 0; node < bench.tree().nodes[0].end; ++node) shown.order.push_back(node);
  GrootPublisher publisher(shape_of(bench.tree()), {.shown = std::move(shown), .print = {}},
                           GrootSockets(std::move(requests->socket), std::move(events->socket)));
  observe(state, bench, &publisher);
}
void changing(benchmark::internal::Benchmark* benchmark) {
  for (const int leaves : {10, kLeaves}) benchmark->Arg(leaves);
}
#define OBSERVED(name, control, attributes)                                              \
  BENCHMARK_CAPTURE(observed_by_nobody, name, control, attributes)->Apply(changing);     \
  BENCHMARK_CAPTURE(observed_by_statistics, name, control, attributes)->Apply(changing); \
  BENCHMARK_CAPTURE(observed_by_recorder, name, control, attributes)->Apply(changing);   \
  BENCHMARK_CAPTURE(observed_by_live_view, name, control, attributes)->Apply(changing);  \
  BENCHMARK_CAPTURE(observed_by_monitor, name, control, attributes)->Apply(changing);    \
  BENCHMARK_CAPTURE(observed_by_groot, name, control, attributes)->Apply(changing)
OBSERVED(parallel, "Parallel", "");
OBSERVED(synchronized, "ParallelRelative", "delta='1'");

// Timed: each call, or by default as `lockstep run` does it on the wall clock.
enum class Timed : std::uint8_t { No, Each, Default };

void watched(benchmark::State& state, Timed timed, const char* control, const char* attributes,
             const char* leaf) {
  TickAlarm alarm(std::chrono::milliseconds(100), std::chrono::seconds(1));
  LeafWatchOptions options;
  if (timed != Timed::No) options.budget = std::chrono::seconds(1);
  if (timed == Timed::Default) options.alarm = &alarm;
  LeafWatch watch(options);
  tick_all(state, BenchTree(control, attributes, leaf, kLeaves), &watch);
}
#define WATCHED(name, ...)                                                 \
  BENCHMARK_CAPTURE(watched, name##_marked, Timed::No, __VA_ARGS__);       \
  BENCHMARK_CAPTURE(watched, name##_default, Timed::Default, __VA_ARGS__); \
  BENCHMARK_CAPTURE(watched, name##_timed, Timed::Each, __VA_ARGS__)
WATCHED(sequence, "Sequence", "", "BenchSuccess");
WATCHED(parallel, "Parallel", "", "BenchRunning");
WATCHED(absolute, "ParallelAbsolute", "barriers='0.75'", "BenchRunning");
WATCHED(relative, "ParallelRelative", "delta='0.1'", "BenchRunning");
WATCHED(absolute_kept, "ParallelAbsolute", "barriers='0.75'", "SdkKeeps");

}  // namespace
