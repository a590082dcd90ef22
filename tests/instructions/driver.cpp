// Ticks trees for a count of their instructions, and prints the name of each. What counts is what
// happens in measured_ticks. See instructions_test.py.
#include <cstdio>

#include "bench/bench_tree.h"
#include "runtime/run.h"

namespace {

using namespace lockstep::host;

// Counts from 0: what it takes to read a real clock differs from machine to machine.
class StepClock final : public Clock {
 public:
  Nanoseconds now() override { return time_ += Nanoseconds(1); }
  void sleep_until(Nanoseconds) override {}
  bool is_real() const override { return true; }

 private:
  Nanoseconds time_{0};
};

enum class Watched : bool { No, Yes };  // as `lockstep run` does on the wall clock

struct Case {
  const char* name;
  const char *control, *attributes, *leaf;
  Watched watched = Watched::No;
};

constexpr Case kCases[] = {
    {"Sequence, built-in leaf", "Sequence", "", "AlwaysSuccess"},
    {"Sequence", "Sequence", "", "BenchSuccess"},
    {"Parallel", "Parallel", "", "BenchRunning"},
    {"ParallelAbsolute", "ParallelAbsolute", "barriers='0.75'", "BenchRunning"},
    {"ParallelAbsolute, kept progress", "ParallelAbsolute", "barriers='0.75'", "SdkKeeps"},
    {"ParallelRelative", "ParallelRelative", "delta='0.1'", "BenchRunning"},
    {"ParallelRelative, kept progress", "ParallelRelative", "delta='0.1'", "SdkKeeps"},
    {"Sequence, timed", "Sequence", "", "BenchSuccess", Watched::Yes},
    {"Parallel, timed", "Parallel", "", "BenchRunning", Watched::Yes},
    {"ParallelAbsolute, timed", "ParallelAbsolute", "barriers='0.75'", "BenchRunning",
     Watched::Yes},
    {"Sequence, leaf over leaf.hpp", "Sequence", "", "SdkSuccess"},
    {"Sequence, leaf that reads a port", "Sequence", "", "SdkRead a='1.5'"},
    {"Sequence, node for BehaviorTree.CPP", "Sequence", "", "BtSuccess"},
    {"Sequence, node for BehaviorTree.CPP that reads a port", "Sequence", "", "BtRead a='1.5'"},
};

// Ticks a tree of one control node and this many leaves.
constexpr int kLeaves = 1000, kTicks = 10;

}  // namespace

// Out of line, and by its name in C, for the tool that counts.
extern "C" [[gnu::noinline]] void measured_ticks(Run& run, int ticks) {
  for (int i = 0; i < ticks; ++i) run.tick(Nanoseconds(0));
}

int main() {
  for (const Case& it : kCases) {
    const BenchTree tree(it.control, it.attributes, it.leaf, kLeaves);
    StepClock clock;
    LeafWatch watch({.budget = std::chrono::hours(1), .clock = &clock});
    Run run(tree.tree(), {.watch = it.watched == Watched::Yes ? &watch : nullptr});
    for (int i = 0; i < 3; ++i) run.tick(Nanoseconds(0));
    measured_ticks(run, kTicks);
    if (run.fault() != nullptr) return 1;
    std::puts(it.name);
  }
}
