// Nanoseconds per node of a tick, beside the floor: as many calls through a table of function
// pointers. The leaves are in real shared objects.
#include <benchmark/benchmark.h>
#include <dlfcn.h>

#include "bench/bench_tree.h"
#include "runtime/run.h"

namespace {

using namespace lockstep;

std::size_t node_count(const BenchTree& bench) {
  return bench.tree().nodes.size();
}

// Ticks the whole tree; one item is one node of it.
void tick_all(benchmark::State& state, const BenchTree& bench, LeafWatch* watch = nullptr) {
  Run run(bench.tree(), {.watch = watch});
  for (auto _ : state) benchmark::DoNotOptimize(run.tick(Nanoseconds(0)));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(node_count(bench)));
}

void flat(benchmark::State& state, const char* control, const char* attributes, const char* leaf) {
  tick_all(state, BenchTree(control, attributes, leaf, state.range(0)));
}

// The same number of calls into the same shared object, and nothing else.
void floor_of_calls(benchmark::State& state) {
  void* library = dlopen(LOCKSTEP_BENCH_LEAVES, RTLD_NOW);
  const auto& plugin = *static_cast<const lockstep_plugin*>(dlsym(library, LOCKSTEP_PLUGIN_ENTRY));
  std::vector<const lockstep_leaf_type*> table(static_cast<std::size_t>(state.range(0)),
                                               plugin.leaf_types[0]);
  benchmark::DoNotOptimize(table.data());
  for (auto _ : state) {
    for (const lockstep_leaf_type* type : table) benchmark::DoNotOptimize(type->tick(nullptr));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int leaves : {10, 100, 1000, 10000, 100000}) benchmark->Arg(leaves);
}

BENCHMARK(floor_of_calls)->Apply(sizes);
BENCHMARK_CAPTURE(flat, sequence, "Sequence", "", "BenchSuccess")->Apply(sizes);
BENCHMARK_CAPTURE(flat, fallback, "Fallback", "", "BenchFailure")->Apply(sizes);
BENCHMARK_CAPTURE(flat, parallel, "Parallel", "", "BenchRunning")->Apply(sizes);
BENCHMARK_CAPTURE(flat, parallel_advance, "Parallel", "", "BenchAdvance")->Apply(sizes);
BENCHMARK_CAPTURE(flat, absolute, "ParallelAbsolute", "barriers='0.75'", "BenchRunning")
    ->Apply(sizes);
BENCHMARK_CAPTURE(flat, absolute_advance, "ParallelAbsolute", "barrier_count='10'", "BenchAdvance")
    ->Apply(sizes);
BENCHMARK_CAPTURE(flat, relative, "ParallelRelative", "delta='0.1'", "BenchRunning")->Apply(sizes);
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

void ports_read(benchmark::State& state) {
  const auto leaf = fmt::format("<BenchRead reads='{}' a='{{x}}' b='{{y}}'/>", state.range(0));
  tick_all(state,
           BenchTree(fmt::format("<Sequence>{}</Sequence>", BenchTree::repeated(leaf, kLeaves))));
}
BENCHMARK(ports_read)->Arg(0)->Arg(1)->Arg(4);

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

void watched(benchmark::State& state, bool timed) {
  LeafWatchOptions options;
  if (timed) options.budget = std::chrono::seconds(1);
  LeafWatch watch(options);
  tick_all(state, BenchTree("Sequence", "", "BenchSuccess", kLeaves), &watch);
}
BENCHMARK_CAPTURE(watched, marked, false);
BENCHMARK_CAPTURE(watched, timed, true);

}  // namespace
