// Nanoseconds per node of a tick, beside the floor: as many calls through a table of function
// pointers. The leaves are in a real shared object.
#include <benchmark/benchmark.h>
#include <dlfcn.h>

#include "bench/bench_tree.h"
#include "runtime/run.h"

namespace {

using namespace lockstep;

void tick(benchmark::State& state, const char* control, const char* attributes, const char* leaf) {
  const BenchTree bench(control, attributes, leaf, state.range(0));
  Run run(bench.tree(), {});
  for (auto _ : state) benchmark::DoNotOptimize(run.tick(Nanoseconds(0)));
  state.SetItemsProcessed(state.iterations() * (state.range(0) + 1));
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
  for (const int leaves : {10, 1000, 100000}) benchmark->Arg(leaves);
}

BENCHMARK(floor_of_calls)->Apply(sizes);
BENCHMARK_CAPTURE(tick, sequence, "Sequence", "", "BenchSuccess")->Apply(sizes);
BENCHMARK_CAPTURE(tick, fallback, "Fallback", "", "BenchFailure")->Apply(sizes);
BENCHMARK_CAPTURE(tick, parallel, "Parallel", "", "BenchRunning")->Apply(sizes);
BENCHMARK_CAPTURE(tick, parallel_absolute, "ParallelAbsolute", "barriers='0.75'", "BenchRunning")
    ->Apply(sizes);
BENCHMARK_CAPTURE(tick, parallel_relative, "ParallelRelative", "delta='0.1'", "BenchRunning")
    ->Apply(sizes);

}  // namespace
