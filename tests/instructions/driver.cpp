// Ticks trees, makes runs of a study and loads trees for a count of their instructions, and prints
// of each by how many leaves or ticks to divide it, and its name. What counts is what happens in
// `measured`. See instructions_test.py.
#include <tinyxml2.h>
#include <unistd.h>

#include <cstdio>
#include <functional>

#include "bench/bench_study.h"
#include "bench/bench_tree.h"
#include "judge/summary/repeated_halts.h"
#include "judge/summary/standstills.h"
#include "judge/summary/statistics.h"
#include "run/checkpoint/checkpoint_writer.h"
#include "run/loop.h"
#include "run/run.h"
#include "run/shape_of.h"
#include "support/step_clock.h"

namespace {

using namespace lockstep::host;

// Yes: each call is timed. Default: as `lockstep run` does on the wall clock.
enum class Watched : std::uint8_t { No, Yes, Default };

struct Case {
  const char* name;
  const char *control, *attributes, *leaf;
  Watched watched = Watched::No;
  const char* first = "";  // a node before the leaves
};

constexpr const char* kWriteEntry = "<Script code='n := 1.5'/>";

constexpr Case kCases[] = {
    {"Sequence, built-in leaf", "Sequence", "", "AlwaysSuccess"},
    {"Sequence", "Sequence", "", "BenchSuccess"},
    {"Parallel", "Parallel", "", "BenchRunning"},
    {"ParallelAbsolute", "ParallelAbsolute", "barriers='0.75'", "BenchRunning"},
    {"ParallelAbsolute, kept progress", "ParallelAbsolute", "barriers='0.75'", "SdkKeeps"},
    {"ParallelAbsolute, paced", "ParallelAbsolute", "barriers='0.75' pace='true'", "BenchRunning"},
    {"ParallelRelative", "ParallelRelative", "delta='0.1'", "BenchRunning"},
    {"ParallelRelative, paced", "ParallelRelative", "delta='0.1' pace='true'", "BenchRunning"},
    {"ParallelRelative, kept progress", "ParallelRelative", "delta='0.1'", "SdkKeeps"},
    {"Sequence, timed", "Sequence", "", "BenchSuccess", Watched::Yes},
    {"Parallel, timed", "Parallel", "", "BenchRunning", Watched::Yes},
    {"ParallelAbsolute, timed", "ParallelAbsolute", "barriers='0.75'", "BenchRunning",
     Watched::Yes},
    {"Sequence, by default", "Sequence", "", "BenchSuccess", Watched::Default},
    {"Parallel, by default", "Parallel", "", "BenchRunning", Watched::Default},
    {"ParallelAbsolute, by default", "ParallelAbsolute", "barriers='0.75'", "BenchRunning",
     Watched::Default},
    {"Sequence, leaf with on_success='n = n + 1'", "Sequence", "",
     "BenchSuccess on_success='n = n + 1'", Watched::No, "<Script code='n := 1'/>"},
    {"Sequence, leaf over leaf.hpp", "Sequence", "", "SdkSuccess"},
    {"Sequence, leaf that reads a port", "Sequence", "", "SdkRead a='1.5'"},
    {"Sequence, leaf that reads an entry", "Sequence", "", "SdkRead a='{n}'", Watched::No,
     kWriteEntry},
    {"Sequence, node for BehaviorTree.CPP", "Sequence", "", "BtSuccess"},
    {"Sequence, node for BehaviorTree.CPP that reads a port", "Sequence", "", "BtRead a='1.5'"},
    {"Sequence, node for BehaviorTree.CPP that reads an entry", "Sequence", "", "BtRead a='{n}'",
     Watched::No, kWriteEntry},
    {"Sequence, leaf that reads a port, timed", "Sequence", "", "SdkRead a='1.5'", Watched::Yes},
    {"Sequence, leaf that reads an entry, timed", "Sequence", "", "SdkRead a='{n}'", Watched::Yes,
     kWriteEntry},
    {"Sequence, node for BehaviorTree.CPP, timed", "Sequence", "", "BtSuccess", Watched::Yes},
    {"Sequence, node for BehaviorTree.CPP that reads a port, timed", "Sequence", "",
     "BtRead a='1.5'", Watched::Yes},
    {"Sequence, node for BehaviorTree.CPP that reads an entry, timed", "Sequence", "",
     "BtRead a='{n}'", Watched::Yes, kWriteEntry},
};

// Ticks a tree of one control node and this many leaves.
constexpr int kLeaves = 1000, kTicks = 10, kManyTicks = 300;

}  // namespace

// Out of line, and by its name in C, for the tool that counts.
extern "C" [[gnu::noipa]] void measured(const std::function<void()>& work) {
  work();
}

namespace {

// False: a leaf has a fault.
bool measure_ticks(const Case& it) {
  const std::string leaves = BenchTree::repeated(fmt::format("<{}/>", it.leaf), kLeaves);
  const BenchTree tree(
      fmt::format("<{0} {1}>{2}{3}</{0}>", it.control, it.attributes, it.first, leaves));
  test::StepClock clock;
  TickAlarm alarm(std::chrono::hours(1), std::chrono::hours(1));
  const bool is_default = it.watched == Watched::Default;
  LeafWatch watch(
      {.budget = std::chrono::hours(1), .clock = &clock, .alarm = is_default ? &alarm : nullptr});
  Run run(tree.tree(), {.watch = it.watched != Watched::No ? &watch : nullptr});
  // By default, some ticks are timed: the first ones, and samples.
  const int first = is_default ? 100 : 3, ticks = is_default ? kManyTicks : kTicks;
  for (int i = 0; i < first; ++i) run.tick(Nanoseconds(0));
  measured([&] {
    for (int i = 0; i < ticks; ++i) run.tick(Nanoseconds(0));
  });
  std::printf("%d %s\n", kLeaves * ticks, it.name);
  return run.fault() == nullptr;
}

// Ticks as `lockstep run` makes them on the virtual clock, with all that its summary measures.
void measure_run() {
  Diagnostics diagnostics;
  PluginSet plugins;
  plugins.load_file(LOCKSTEP_BENCH_MOTION, diagnostics);
  const Tree tree =
      test::compiled(fmt::format("<root lockstep=\"1\"><BehaviorTree ID=\"B\"><ParallelAbsolute "
                                 "barrier_count='10'>{}</ParallelAbsolute></BehaviorTree></root>",
                                 BenchTree::repeated("<Advance step='0.00001'/>", kLeaves)),
                     plugins);
  const Shape shape = shape_of(tree);
  Statistics statistics(shape);
  RepeatedHalts halts(shape, [](NodeIndex, const std::string&) {});
  Standstills standstills(shape, std::chrono::seconds(5), [](NodeIndex, const auto&) {});
  Observer* const observers[] = {&statistics, &halts, &standstills};
  LeafWatch watch({});
  Run run(tree, {.virtual_time = true, .watch = &watch});
  VirtualClock clock;
  LoopOptions loop;
  loop.rate = 100;
  loop.max_ticks = kManyTicks;
  run_loop(run, clock, loop, observers);
  measured([&] { run_loop(run, clock, loop, observers); });
  std::printf("%d ParallelAbsolute of Advance, with the measures of a run\n", kLeaves * kManyTicks);
}

// As "Parallel", in a run that a checkpoint keeps. The thread that writes is not counted.
void measure_kept_run() {
  const BenchTree tree(
      fmt::format("<Parallel>{}</Parallel>", BenchTree::repeated("<BenchRunning/>", kLeaves)));
  const std::string file = fmt::format("{}/lockstep-{}.checkpoint", P_tmpdir, getpid());
  Run run(tree.tree(), {});
  CheckpointWriter writer(std::make_unique<CheckpointFile>(file), {.period = from_seconds(3600)});
  if (!writer.begin(run.ticker(), {}, 0, 0)) return;
  int time = 0;
  const auto tick = [&] {
    run.tick(Nanoseconds(++time));
    writer.after_tick(run.ticker(), 1);
  };
  for (int i = 0; i < 3; ++i) tick();
  measured([&] {
    for (int i = 0; i < kTicks; ++i) tick();
  });
  std::printf("%d Parallel, kept\n", kLeaves * kTicks);
  writer.end(0, Nanoseconds(0));
  std::remove(file.c_str());
  std::remove((file + ".lock").c_str());
}

// The same runs as a study makes them, and as a loop that knows two leaves and nothing else.
void measure_study() {
  constexpr std::uint64_t kRuns = 50;
  const BenchStudy study(kTwoLeaves);
  StudyRun run(study.cell, study.measures, 1'000'000, nullptr);
  run.run(run_seed(0, 0, kRuns));
  std::uint64_t ticks = 0;
  measured([&] {
    for (std::uint64_t i = 0; i < kRuns; ++i) ticks += run.run(run_seed(0, 0, i)).ticks;
  });
  std::printf("%llu a tick of a study\n", static_cast<unsigned long long>(ticks));
  ticks = 0;
  measured([&] {
    for (std::uint64_t i = 0; i < kRuns; ++i) ticks += two_leaves_without_a_tree(i);
  });
  std::printf("%llu the same numbers in a loop\n", static_cast<unsigned long long>(ticks));
}

// A tree of leaves with a name each, as a file has it, is loaded and freed; beside it tinyxml2
// only parses it.
void measure_load(const char* name, const char* leaf) {
  std::string text = "<root lockstep=\"1\">\n  <BehaviorTree ID=\"B\">\n    <Sequence>\n";
  for (int i = 0; i < kLeaves; ++i) text += fmt::format("      <{} name=\"n{}\"/>\n", leaf, i);
  text += "    </Sequence>\n  </BehaviorTree>\n</root>\n";
  Diagnostics diagnostics;
  PluginSet plugins;
  plugins.load_file(LOCKSTEP_BENCH_SDK, diagnostics);
  measured([&] { tinyxml2::XMLDocument().Parse(text.data(), text.size()); });
  std::printf("%d the XML of a %s\n", kLeaves, name);
  const auto load = [&] { test::compiled(text, plugins); };
  load();
  measured(load);
  std::printf("%d a %s is loaded\n", kLeaves, name);
}

}  // namespace

int main() {
  for (const Case& it : kCases) {
    if (!measure_ticks(it)) return 1;
  }
  measure_run();
  measure_kept_run();
  measure_study();
  measure_load("built-in leaf with a name", "AlwaysSuccess");
  measure_load("built-in leaf with a name and a parameter", "Wait seconds='0.5'");
  measure_load("leaf with a name and a port", "SdkRead a='1.5'");
}
