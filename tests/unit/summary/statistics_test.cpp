#include "judge/summary/statistics.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>

#include "engine/synchronized.h"
#include "run/shape_of.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::WatchedRun;

constexpr const char* kTree = "ParallelAbsolute[barriers=.5;1](a b)";

Summary summary_of(WatchedRun& run) {
  Statistics statistics(shape_of(run.run.tree()));
  run.watch({&statistics});
  return statistics.summary();
}

TEST_CASE("the summary of a run") {
  WatchedRun run(kTree, "a+.1 b+.3");
  const Summary summary = summary_of(run);
  CHECK(summary.result == RunResult::Success);
  CHECK(summary.reason == StopReason::Completed);
  CHECK(summary.ticks == 10);
  CHECK(summary.seconds == 0.9);
  CHECK_FALSE(summary.period);
  REQUIRE(summary.synchronized_nodes.size() == 1);
  const SynchronizedSummary& node = summary.synchronized_nodes[0];
  CHECK(node.path == "Test/ParallelAbsolute");
  CHECK(node.samples == 10);
  CHECK(node.distance_sum == Approx(2.1));
  CHECK(node.distance_mean == Approx(0.21));
  CHECK(node.largest_spread == Approx(0.4));
  CHECK(node.children.at(1).name == "b");
  CHECK(node.children.at(1).held_seconds == Approx(0.3));
  CHECK(node.children.at(1).held_ticks == 3);
}

TEST_CASE("a spread is within its bound where no progress falls") {
  std::size_t tight = 0;
  for (unsigned number = 0; number < 400; ++number) {
    const auto tenths = [&](unsigned divisor) { return std::to_string(1 + number / divisor % 5); };
    const std::string tree = number % 2 == 0
                                 ? "ParallelRelative[delta=." + tenths(2) + "](a b c)"
                                 : "ParallelAbsolute[barriers=." + tenths(2) + ";.9](a b c)";
    WatchedRun run(tree, "a+.0" + tenths(10) + " b+." + tenths(50) + " c+.0" + tenths(3));
    const Summary summary = summary_of(run);
    INFO(tree << ' ' << number);
    const SynchronizedSummary& node = summary.synchronized_nodes.at(0);
    REQUIRE(node.spread_bound);
    CHECK(node.largest_spread <= *node.spread_bound + kProgressEpsilon);
    tight += node.largest_spread > *node.spread_bound - 0.05;
  }
  CHECK(tight > 40);
}

TEST_CASE("a progress that falls takes the bound away") {
  WatchedRun run("ParallelRelative[delta=.1](a b)", "a=R.5R.2R.3S b+.25");
  const Summary summary = summary_of(run);
  CHECK_FALSE(summary.synchronized_nodes.at(0).spread_bound);
  REQUIRE(summary.notes.size() == 1);
  CHECK(summary.notes[0].starts_with("the progress of 'Test/ParallelRelative/a' fell, first at"));
}

TEST_CASE("a progress that rises while it is held takes the bound away") {
  WatchedRun run("ParallelRelative[delta=.1](a b)", "a+.1 b=R~0,.3,.5,.7,.9");
  const Summary summary = summary_of(run);
  const SynchronizedSummary& node = summary.synchronized_nodes.at(0);
  CHECK_FALSE(node.spread_bound);
  CHECK(node.largest_spread > .1 + node.step_length);
  REQUIRE(summary.notes.size() == 2);  // the leaf is noted too
  CHECK(summary.notes[1] ==
        "the progress of 'Test/ParallelRelative/b' rose while it was held, first at 0.200 s: the "
        "spread has no bound then");
}

TEST_CASE("tick periods are measured on a real clock only") {
  WatchedRun run(kTree, "a+.1 b+.3");
  run.start.real_time = true;
  const Summary summary = summary_of(run);
  REQUIRE(summary.period);
  CHECK(summary.period->max == 0.1);
  CHECK(summary.period->p50 == Approx(0.1).epsilon(0.01));
}

TEST_CASE("how late ticks began is counted by powers of two") {
  WatchedRun run(kTree, "a+.1 b+.3");
  run.start.real_time = true;
  Summary summary = summary_of(run);
  summary.lateness = LatenessSummary{.p50 = 2e-6, .p99 = 0.1, .max = 0.1, .ticks = {}};
  summary.lateness->ticks.resize(28);
  summary.lateness->ticks[12] = 6;  // 2 to 4 us
  summary.lateness->ticks[17] = 2;  // 66 to 131 us
  summary.lateness->ticks[27] = 2;  // 67 to 134 ms
  std::string text;
  write_text(summary, text, false);
  CHECK_THAT(text, Catch::Contains("  late       p50 0.002 ms, p99 100.000 ms, max 100.000 ms\n"
                                   "             60 % within 0.0164 ms, 80 % within 0.131 ms, "
                                   "80 % within 1.05 ms, 80 % within 8.39 ms, 80 % within 67.1 ms, "
                                   "all within 537 ms\n"));
  CHECK_THAT(to_json(summary),
             Catch::Contains(R"("histogram":[{"below_s":4.096e-06,"ticks":6},)") &&
                 Catch::Contains(R"({"below_s":0.000131072,"ticks":2},)") &&
                 Catch::Contains(R"({"below_s":0.134217728,"ticks":2}]})"));
}

TEST_CASE("two ticks have one period between them") {
  WatchedRun run(kTree, "a+.5 b+.5");
  run.start.real_time = true;
  const Summary summary = summary_of(run);
  REQUIRE(summary.period);
  CHECK(summary.period->p50 == Approx(0.1).epsilon(0.01));
}

TEST_CASE("a child that is held when the run ends was held until then") {
  WatchedRun run("ParallelAbsolute[barriers=.5](a b)", "a=R.1RRRX b=R.9");
  const Summary summary = summary_of(run);
  CHECK(summary.reason == StopReason::Fault);
  CHECK(summary.fault.starts_with("Test/ParallelAbsolute/a: "));
  CHECK(summary.synchronized_nodes[0].children[1].held_ticks == 4);
  CHECK(summary.synchronized_nodes[0].children[1].held_seconds == Approx(0.3));
}

std::string text_of(const Summary& summary, bool color = false) {
  std::string text;
  write_text(summary, text, color);
  return text;
}

TEST_CASE("the summary as text") {
  WatchedRun run(kTree, "a+.1 b+.3");
  run.start.real_time = true;
  Summary summary = summary_of(run);
  summary.overruns = 2;
  summary.skipped = 3;
  summary.notes = {"the recording is cut"};
  CHECK(text_of(summary) ==
        "success after 10 ticks, 0.900 s\n"
        "  period     p50 100.000 ms, p99 100.000 ms, max 100.000 ms\n"
        "  late       p50 0.000 ms, p99 0.000 ms, max 0.000 ms\n"
        "             all within 0.0164 ms\n"
        "  overruns   2 (deadlines skipped: 3)\n"
        "  Test/ParallelAbsolute (ParallelAbsolute, 10 ticks)\n"
        "    progress distance 2.1, mean 0.21 a tick\n"
        "    largest spread 0.4 (bound 0.8), longest step 0.3\n"
        "    a  did not wait\n"
        "    b  waited 1 time, 0.300 s in 3 ticks\n"
        "note: the recording is cut\n");
  CHECK(text_of(summary, true).starts_with("\x1b[32msuccess\x1b[0m after"));
}

TEST_CASE("faults that the run went on after are counted, and the first of them told") {
  WatchedRun run("Sequence(a)", "a=RRRS");
  run.faults[1] = {{1, "threw"}, {1, "threw again"}};
  run.faults[2] = {{1, "x"}, {1, "x"}, {1, "x"}, {1, "not told"}, {1, "not told"}};
  const Summary summary = summary_of(run);
  CHECK(summary.faults == 7);
  REQUIRE(summary.notes.size() == CappedNotes::kMost + 1);
  CHECK(summary.notes[0] ==
        "the leaf 'Test/Sequence/a' failed in tick 1: threw; counted as Failure");
  CHECK(summary.notes[2] == "the leaf 'Test/Sequence/a' failed in tick 2: x; counted as Failure");
  CHECK(summary.notes[5] == "and 2 faults more");
  CHECK(to_json(summary).find(R"("faults":7,)") != std::string::npos);
}

TEST_CASE("leaves whose progress was out of range are noted, a few by name") {
  WatchedRun run("ParallelRelative[delta=1](a b)", "a=R42RS b=R.5RS");
  CHECK(summary_of(run).notes ==
        std::vector<std::string>{"the leaf 'Test/ParallelRelative/a' reported the progress 42: "
                                 "progress is a share from 0 to 1, so it counts as 1"});
  WatchedRun many("ParallelRelative[delta=1](a b c d e f g)",
                  "a=R-2S b=R2S c=R3S d=R4S e=R5S f=R6S g=RS");
  const Summary summary = summary_of(many);
  REQUIRE(summary.notes.size() == 6);
  CHECK(
      summary.notes[0].ends_with("reported the progress -2: progress is a share from 0 to 1, "
                                 "so it counts as 0"));
  CHECK(summary.notes[5] == "6 leaves in all reported such a progress");
}

TEST_CASE("leaves that continued while they were held are noted and counted") {
  WatchedRun run("ParallelAbsolute[barriers=.5](a b)", "a=R.1RRRRRS b=R~0,.6,.7,.8,.9");
  const Summary summary = summary_of(run);
  CHECK(summary.went_on == 1);
  REQUIRE(!summary.notes.empty());
  CHECK(summary.notes[0] ==
        "the leaf 'Test/ParallelAbsolute/b' continued while it was held: its progress rose from "
        "0.6 to 0.8");
  CHECK(to_json(summary).find(R"("went_on_while_held":1,)") != std::string::npos);
}

TEST_CASE("the worst tick is reported with its leaf, on a real clock only") {
  WatchedRun run("Sequence(a)", "a=RS");
  run.worst = {.tick = 1, .took = Nanoseconds(8'200'000), .leaf = {}, .leaf_took = {}};
  CHECK_FALSE(summary_of(run).worst);
  run.start.real_time = true;
  WatchedRun real("Sequence(a)", "a=RS");
  real.start.real_time = true;
  real.worst = run.worst;
  const Summary without_leaf = summary_of(real);
  CHECK(text_of(without_leaf).find("\n  worst tick 1: 8.200 ms\n") != std::string::npos);
  CHECK(to_json(without_leaf).find(R"("worst_tick":{"tick":1,"took_s":0.0082},)") !=
        std::string::npos);
  Summary summary = without_leaf;
  summary.worst->leaf = "Test/Sequence/a";
  summary.worst->leaf_took = 0.0079;
  CHECK(text_of(summary).find("\n  worst tick 1: 8.200 ms, of which 7.900 ms in "
                              "Test/Sequence/a\n") != std::string::npos);
  CHECK(
      to_json(summary).find(R"("took_s":0.0082,"leaf":"Test/Sequence/a","leaf_took_s":0.0079})") !=
      std::string::npos);
}

TEST_CASE("leaves over the tick budget are reported with their times") {
  Summary summary;
  summary.tick_budget = 0.01;
  summary.over_budget = {{.path = "Main/arm",
                          .calls = 120,
                          .over_budget = 3,
                          .p50 = 0.0001,
                          .p99 = 0.012,
                          .max = 0.015}};
  CHECK(text_of(summary).find("  over the tick budget of 10 ms: Main/arm in 3 calls, "
                              "max 15.000 ms; 120 ticks: p50 0.100 ms, p99 12.000 ms\n") !=
        std::string::npos);
  CHECK(to_json(summary).find(
            R"("tick_budget_s":0.01,"over_budget":[{"leaf":"Main/arm","ticks":120,"over_budget":3,)"
            R"("p50_s":0.0001,"p99_s":0.012,"max_s":0.015}],)") != std::string::npos);
}

TEST_CASE("why a run failed: the path from the root to the leaf that decided") {
  WatchedRun run("Sequence(a Fallback(b Inverter(c?)))", "a=S b=F c=S");
  const Summary summary = summary_of(run);
  CHECK(text_of(summary) ==
        "failure after 1 tick, 0.000 s\n"
        "  decided by Test/Sequence/Fallback/Inverter/c:\n"
        "    Sequence: failure\n"
        "      Fallback: failure (2 of 2 children)\n"
        "        Inverter: failure\n"
        "          c (ScriptedCondition): success\n");
  CHECK(to_json(summary).find(
            R"("reason":"completed","why_failed":[{"path":"Test/Sequence","kind":"Sequence",)"
            R"("status":"failure","children":2,"agreeing":1},)") != std::string::npos);
  WatchedRun good("Inverter(a)", "a=F");
  CHECK(text_of(summary_of(good)) == "success after 1 tick, 0.000 s\n");
}

TEST_CASE("why a run failed: of a deep tree the first nodes and the last") {
  std::string tree = "a";
  for (int depth = 0; depth < 50; ++depth) tree = "ForceFailure(" + tree + ")";
  WatchedRun run(tree, "a=S");
  const std::string text = text_of(summary_of(run));
  CHECK(std::count(text.begin(), text.end(), '\n') == 2 + 5 + 1 + 15);
  CHECK(text.find("            ForceFailure: failure\n"
                  "              ... 31 nodes more\n"
                  "                ForceFailure: failure\n") != std::string::npos);
  CHECK(text.ends_with("  a (Scripted): success\n"));
}

TEST_CASE("synchronized nodes that no tick reached are only counted") {
  WatchedRun run("Sequence(ParallelAbsolute[barriers=.5](a b) ParallelRelative[delta=1](c d))",
                 "a=F b=R c=S d=S");
  const Summary summary = summary_of(run);
  REQUIRE(summary.synchronized_nodes.size() == 1);
  CHECK(summary.synchronized_nodes[0].path == "Test/Sequence/ParallelAbsolute");
  CHECK(text_of(summary).ends_with("  1 synchronized node was never reached\n"));
  CHECK(to_json(summary).ends_with(R"("never_reached":1,"standstills":[],"notes":[]})"));
}

TEST_CASE("why a run stopped") {
  Summary summary;
  summary.reason = StopReason::Timeout;
  CHECK(text_of(summary).starts_with(
      "stopped: the time limit (--timeout) was reached after 0 ticks"));
  summary.reason = StopReason::MaxTicks;
  CHECK(text_of(summary).starts_with("stopped: the tick limit (--max-ticks) was reached after"));
  summary.reason = StopReason::Signal;
  summary.signal = SIGINT;
  CHECK(text_of(summary).starts_with("stopped: signal: Interrupt after"));
  summary.result = RunResult::Fault;
  summary.reason = StopReason::Fault;
  summary.fault = "Test/a: broke";
  CHECK(text_of(summary).starts_with("fault after 0 ticks, 0.000 s: Test/a: broke\n"));
  CHECK(text_of(summary, true).starts_with("\x1b[31mfault\x1b[0m after "));
  CHECK(to_json(summary).starts_with(
      R"({"result":"fault","reason":"fault","fault":"Test/a: broke",)"));
}

TEST_CASE("the summary as JSON") {
  WatchedRun run("ParallelRelative[delta=.5](a b)", "a+.25 b+.5");
  CHECK(
      to_json(summary_of(run)) ==
      R"({"result":"success","reason":"completed","why_failed":[],"ticks":4,"time_s":0.3,"period":null,"lateness":null,)"
      R"("overruns":0,"skipped":0,"worst_tick":null,"faults":0,"went_on_while_held":0,)"
      R"("tick_budget_s":null,)"
      R"("over_budget":[],"synchronized_nodes":[{"path":"Test/ParallelRelative",)"
      R"("kind":"ParallelRelative","samples":4,"progress_distance":1.0,)"
      R"("progress_distance_mean":0.25,"largest_spread":0.5,"spread_bound":1.0,)"
      R"("step_length":0.5,"children":[)"
      R"({"name":"a","held_s":0.0,"held_ticks":0,"waits":0},)"
      R"({"name":"b","held_s":0.0,"held_ticks":0,"waits":0}]}],)"
      R"("pools":[],"never_reached":0,"standstills":[],"notes":[]})");
}

}  // namespace
}  // namespace lockstep::host
