// A run of a study is the run that the loop makes on the virtual clock, however it ends.
#include "study/study_run.h"

#include <signal.h>

#include <catch2/catch.hpp>

#include "judge/measure/measure_spec.h"
#include "run/loop.h"
#include "run/shape_of.h"
#include "support/compiled.h"
#include "unit/plugin/lab_plugin.h"

namespace lockstep::host::test {
namespace {

constexpr double kRate = 30;  // its period is no whole number of nanoseconds
constexpr std::uint64_t kMaxTicks = 40;

int g_looks = 0;
int stop_at_third_look() {
  return ++g_looks >= 3 ? SIGINT : 0;
}

void begin_run() {
  g_looks = 0;
  lab.leaves.clear();
}

struct RunOutcome {
  StopReason reason;
  RunResult result;
  int signal;
  std::uint64_t ticks;
  std::int64_t time, last;
  std::optional<Fault> fault;
  std::string values;

  friend bool operator==(const RunOutcome&, const RunOutcome&) = default;
};

RunOutcome outcome(const RunEnd& end, std::span<const double> values) {
  std::string text;
  for (const double value : values) text += std::to_string(value) + " ";
  return {end.reason,       end.result(),     end.signal, end.ticks,
          end.time.count(), end.last.count(), end.fault,  text};
}

RunOutcome looped(const StudyCell& cell, std::span<const MeasureSpec> measures, int (*stop)()) {
  begin_run();
  RunMeasures measured(shape_of(cell.tree), measures, cell.rate);
  Run run(cell.tree, {.rate = cell.rate, .virtual_time = true});
  VirtualClock clock;
  Observer* const observers[] = {&measured};
  const LoopOptions options{
      .rate = cell.rate, .max_ticks = kMaxTicks, .timeout = std::nullopt, .stop_signal = stop};
  return outcome(run_loop(run, clock, options, observers), measured.values());
}

// Also in a run that is not the first.
RunOutcome studied(const StudyCell& cell, std::span<const MeasureSpec> measures, int (*stop)()) {
  StudyRun run(cell, measures, kMaxTicks, stop);
  std::optional<RunOutcome> last;
  for (int i = 0; i < 2; ++i) {
    begin_run();
    const RunEnd end = run.run(0);
    const RunOutcome now = outcome(end, run.values());
    if (last) CHECK(now == *last);
    last = now;
  }
  return *last;
}

RunOutcome same_in_both(const StudyCell& cell, int (*stop)() = nullptr) {
  std::vector<MeasureSpec> measures;
  for (const char* text : {"progress-distance", "spread", "duration", "ticks", "success"}) {
    measures.push_back(parse_measure(text).value());
  }
  const RunOutcome one = studied(cell, measures, stop);
  CHECK(one == looped(cell, measures, stop));
  return one;
}

std::string in_tree(const std::string& nodes) {
  return R"(<root lockstep="1"><BehaviorTree ID="T">)" + nodes + "</BehaviorTree></root>";
}

RunOutcome same_in_both(const std::string& nodes, int (*stop)() = nullptr) {
  CAPTURE(nodes);
  return same_in_both({.tree = compiled(in_tree(nodes)), .rate = kRate}, stop);
}

}  // namespace

TEST_CASE("a run of a study is that of the loop on the virtual clock") {
  const std::string waits =
      R"(<ParallelAbsolute barriers="0.5"><Wait seconds="1"/><Wait seconds="0.5"/></ParallelAbsolute>)";
  CHECK(same_in_both(waits).result == RunResult::Success);
  CHECK(same_in_both(waits).ticks == 31);
  CHECK(same_in_both("<AlwaysFailure/>").result == RunResult::Failure);
  CHECK(same_in_both(R"(<Wait seconds="9"/>)").reason == StopReason::MaxTicks);
  CHECK(same_in_both(R"(<AlwaysSuccess skip_if="true"/>)").result == RunResult::Skipped);

  const RunOutcome stopped = same_in_both(R"(<Wait seconds="9"/>)", stop_at_third_look);
  CHECK(stopped.reason == StopReason::Signal);
  CHECK(stopped.signal == SIGINT);
  CHECK(stopped.ticks == 2);

  const RunOutcome faulty = same_in_both(
      R"(<Sequence><Script code="n := 0"/><Repeat times="{n}"><AlwaysSuccess/></Repeat></Sequence>)");
  CHECK(faulty.reason == StopReason::Fault);
  CHECK(faulty.ticks == 1);
}

TEST_CASE("a run of a study whose leaf cannot be created is that of the loop") {
  lab = {};
  PluginSet plugins;
  Diagnostics diagnostics;
  REQUIRE(plugins.add(lab_plugin(), "lab", diagnostics));
  lab.leaf_that_fails = 1;
  const std::string leaf =
      R"(<Lab flag="true" count="{n}" speed="{v}" text="{t}" list="{l}" result="{r}"/>)";
  const RunOutcome faulty = same_in_both(
      StudyCell{.tree = compiled(in_tree("<Sequence>" + leaf + leaf + "</Sequence>"), plugins)});
  CHECK(faulty.reason == StopReason::Fault);
  CHECK(faulty.ticks == 0);
}

}  // namespace lockstep::host::test
