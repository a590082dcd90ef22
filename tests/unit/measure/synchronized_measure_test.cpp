#include "judge/measure/synchronized_measure.h"

#include <catch2/catch.hpp>

#include "engine/synchronized.h"
#include "run/live_moments.h"
#include "support/scripted_run.h"

namespace lockstep::host {
namespace {

using test::ScriptedRun;

constexpr Nanoseconds kPeriod = std::chrono::milliseconds(100);

// Runs to the end, measuring the synchronized node that stands at `place` among them, from the tick
// `first` on.
struct Measured {
  Measured(std::string_view tree, std::string_view leaves, std::size_t place = 0, int first = 0)
      : run(tree, leaves),
        moments(run.tree()),
        measure(std::move(measured_nodes(shape_of(run.tree())).at(place).measure)),
        parallel(shape_of(run.tree()), synchronized_nodes(run.tree()).at(place)) {
    Nanoseconds now{0};
    for (Status status = Status::Running; status == Status::Running && ticks < 100; ++ticks) {
      status = run.tick(now);
      const Moment& moment = moments.after_tick(run.ticker(), 0, now);
      if (ticks == first && first > 0) measure.join(Joint::Lost);
      if (ticks >= first) measure.after_tick(parallel.read(moment));
      now += kPeriod;
    }
    measure.run_ended(now);
  }
  double held_seconds(std::size_t child) const { return to_seconds(measure.held()[child].time()); }
  std::uint64_t held_ticks(std::size_t child) const { return measure.held()[child].ticks(); }

  ScriptedRun run;
  LiveMoments moments;
  SynchronizedMeasure measure;
  SynchronizedTicks parallel;
  int ticks = 0;
};

struct WorkedTrace {
  const char *name, *tree, *leaves;
  int ticks;
  double distance;
  std::uint64_t held[3];  // ticks in which the child is '-'
};

constexpr WorkedTrace kWorkedTraces[] = {
    {"A1", "ParallelAbsolute[barriers=.5;1](a b)", "a+.1 b+.3", 10, 2.10, {0, 3}},
    {"A2t", "ParallelAbsolute[barriers=.5;1 at_barrier=tick](a b)", "a+.1 b+.25", 10, 2.50, {0, 2}},
    {"A2w", "ParallelAbsolute[barriers=.5;1](a b)", "a+.1 b+.25", 10, 1.50, {0, 3}},
    {"A3", "ParallelAbsolute[barriers=.3](a b)", "a+.2 b+.4", 5, 0.60, {0, 1}},
    {"A4w", "ParallelAbsolute[barrier_count=4](a b c)", "a+.1 b+.2 c+.5", 10, 4.40, {0, 4, 4}},
    {"R1", "ParallelRelative[delta=.2](a b)", "a+.1 b+.3", 10, 2.30, {0, 4}},
    {"R2", "ParallelRelative[delta=0](a b)", "a+.2 b+.3", 7, 0.60, {1, 3}},
    {"R4", "ParallelRelative[delta=1](a b)", "a+.25 b+.5", 4, 1.00, {0, 0}},
    {"A5", "ParallelAbsolute[barriers=.3;.6;1](a b)", "a+.4,-.2,.3,.3,.3 b+.35", 5, 0.85, {0, 2}},
};

TEST_CASE("the worked traces, measured") {
  for (const WorkedTrace& trace : kWorkedTraces) {
    INFO(trace.name);
    const Measured measured(trace.tree, trace.leaves);
    CHECK(measured.ticks == trace.ticks);
    CHECK(measured.measure.distance().sum() == Approx(trace.distance));
    CHECK(measured.measure.distance().samples() == static_cast<std::uint64_t>(trace.ticks));
    for (std::size_t child = 0; child < measured.parallel.children().size(); ++child) {
      CHECK(measured.held_ticks(child) == trace.held[child]);
      const auto ticks = static_cast<double>(trace.held[child]);
      CHECK(measured.held_seconds(child) == Approx(ticks * 0.1));
    }
  }
}

TEST_CASE("a run that is joined where a step before it was longer has no bound of the spread") {
  const char* tree = "ParallelRelative[delta=.2](a b)";
  const Measured whole(tree, "a+.05 b+.5,.05"), joined(tree, "a+.05 b+.5,.05", 0, 2);
  CHECK(whole.measure.bound().value() == Approx(.2 + .5));
  CHECK(joined.measure.largest_spread() == Approx(.4));
  CHECK_FALSE(joined.measure.bound());
  CHECK(Measured(tree, "a+.05 b+.1", 0, 2).measure.bound().value() == Approx(.2 + .1));
}

TEST_CASE("of a pool, only the waits of its members are measured") {
  SynchronizedMeasure measure(2, Guards(), Synchronization::Resources, true);
  const bool held[] = {false, true}, succeeded[] = {false, false};
  for (int tick = 0; tick < 3; ++tick) {
    const double progress[] = {tick == 1 ? 0.75 : 0.25, 0.0};
    measure.after_tick({.time = tick * kPeriod,
                        .ticked = true,
                        .status = Status::Running,
                        .used = progress,
                        .progress = progress,
                        .held = held,
                        .succeeded = succeeded});
  }
  measure.run_ended(3 * kPeriod);
  CHECK(measure.distance().samples() == 3);
  CHECK(measure.held()[1].ticks() == 3);
  CHECK(measure.held()[1].pauses() == 1);
  CHECK(to_seconds(measure.held()[1].time()) == Approx(0.3));
  CHECK_FALSE(measure.falls().while_ticked());
  CHECK_FALSE(measure.falls().rise_while_held());
  CHECK_FALSE(measure.step_length() > 0);
}

TEST_CASE("a node is sampled only in ticks that reach it") {
  const Measured measured("Sequence[memory=true](w ParallelRelative[delta=1](a b))",
                          "w=RRS a+.5 b+.5");
  CHECK(measured.ticks == 4);
  CHECK(measured.measure.distance().samples() == 2);
}

TEST_CASE("a child is held by its own parent, not by one further up") {
  // Tick 0 brings b to .2 and c to .5; the outer node withholds the inner one in ticks 1 to 3.
  // From tick 4 on nothing is left to wait for out there, and the inner node holds c in 4 and 5.
  const char* tree = "ParallelAbsolute[barriers=.2](a ParallelRelative[delta=0](b c))";
  const Measured outer(tree, "a+.05 b+.2 c+.5");
  const Measured inner(tree, "a+.05 b+.2 c+.5", 1);
  CHECK(outer.held_ticks(1) == 3);
  CHECK(inner.measure.distance().samples() == 6);
  CHECK(inner.held_ticks(1) == 2);
  CHECK(inner.held_seconds(1) == Approx(0.2));
}

TEST_CASE("the tick in which a held child is halted counts as held, its time ends there") {
  const Measured failed("ParallelAbsolute[barriers=.5](a b)", "a=R.1RRF b+.6");
  CHECK(failed.ticks == 4);
  CHECK(failed.held_ticks(1) == 3);
  CHECK(failed.held_seconds(1) == Approx(0.2));
  const Measured ended("Parallel(ParallelAbsolute[barriers=.5](a b) c)", "a=R.1R b+.6 c=RRRF");
  CHECK(ended.ticks == 4);
  CHECK(ended.held_ticks(1) == 3);
  CHECK(ended.held_seconds(1) == Approx(0.2));
}

TEST_CASE("a child that had completed when its node was ended was not held") {
  const Measured measured("Parallel(ParallelRelative[delta=1](a b) c)", "a=S b=R c=RRF");
  CHECK(measured.ticks == 3);
  CHECK(measured.held_ticks(0) == 0);
  CHECK(measured.held_ticks(1) == 0);
}

TEST_CASE("the last step of a node counts, also when an ancestor ends in the same tick") {
  Measured measured("Parallel(Sequence[memory=true](ParallelRelative[delta=1](a b) w) c)",
                    "a+.5 b+.3,.7 w=R c=RF");
  CHECK(measured.ticks == 2);
  CHECK(measured.run.ticker().status(2) == Status::Idle);
  CHECK(measured.measure.step_length() == Approx(0.7));
}

TEST_CASE("a node that an ancestor has ended begins anew, without a step back") {
  const Measured measured("Retry[attempts=2](Parallel(ParallelRelative[delta=1](a b) c))",
                          "a+.4 b+.2 c=RRFRRF");
  CHECK(measured.ticks == 6);
  CHECK(measured.measure.step_length() == Approx(0.4));
}

TEST_CASE("ticks in a row in which a child is held are one wait") {
  const Measured often("ParallelRelative[delta=0](a b)", "a+.2 b+.3");
  CHECK(often.held_ticks(1) == 3);
  CHECK(often.measure.held()[0].pauses() == 1);
  CHECK(often.measure.held()[1].pauses() == 3);
  const Measured once("ParallelAbsolute[barriers=.5;1](a b)", "a+.1 b+.3");
  CHECK(once.held_ticks(1) == 3);
  CHECK(once.measure.held()[1].pauses() == 1);
  CHECK(once.measure.held()[0].pauses() == 0);
}

TEST_CASE("a wait goes on while the node itself is held") {
  // The inner node holds c in tick 1 and from 4 on, the outer one holds the inner in 2 and 3.
  const Measured inner("ParallelAbsolute[barriers=.2](a ParallelRelative[delta=0](b c))",
                       "a+.05 b+.1 c+.5", 1);
  CHECK(inner.held_ticks(1) == 4);
  CHECK(inner.measure.held()[1].pauses() == 1);
}

TEST_CASE("a new activation is measured on, without a step back to zero") {
  const Measured measured("Repeat[times=2](ParallelRelative[delta=1](a b))", "a+.1 b+.2");
  CHECK(measured.ticks == 20);
  CHECK(measured.measure.step_length() == Approx(0.2));
}

struct Guarded {
  const char *law, *tree, *without;  // a guard, and the same node without it
};

TEST_CASE("a guard is part of no measure") {
  constexpr const char* kLeaves = "a+.01 b+.02 g=S";
  constexpr Guarded kRows[] = {
      {"relative", "ParallelRelative[delta=.05](g? a b)", "ParallelRelative[delta=.05](a b)"},
      {"absolute, and the guard last", "ParallelAbsolute[barriers=.5](a b g?)",
       "ParallelAbsolute[barriers=.5](a b)"},
      {"below decorators and control nodes",
       "ParallelRelative[delta=.05](Inverter(Fallback(Inverter(g?))) a b)",
       "ParallelRelative[delta=.05](a b)"},
      {"in a member of a barrier",
       "Parallel(SyncProgress[barrier=lift](g?) SyncProgress[barrier=lift](a) "
       "SyncProgress[barrier=lift](b)) barrier[name=lift delta=.05]",
       "Parallel(SyncProgress[barrier=lift](a) SyncProgress[barrier=lift](b)) "
       "barrier[name=lift delta=.05]"},
  };
  for (const Guarded& row : kRows) {
    INFO(row.law);
    const Measured with(row.tree, kLeaves), without(row.without, "a+.01 b+.02");
    CHECK(with.measure.distance().samples() == without.measure.distance().samples());
    CHECK(with.measure.distance().sum() == Approx(without.measure.distance().sum()));
    CHECK(with.measure.largest_spread() == without.measure.largest_spread());
    CHECK(with.measure.step_length() == without.measure.step_length());
    CHECK(with.measure.bound() == without.measure.bound());
    CHECK(with.measure.largest_spread() > 0);
  }
}

TEST_CASE("a guard that is skipped or fails leaves the bound of the spread as it is") {
  for (const char* guard : {"g=SK", "g=SFS"}) {
    const Measured measured("ParallelRelative[delta=.05 failure_count=2](g? a b)",
                            std::string("a+.01 b+.02 ") + guard);
    REQUIRE(measured.measure.bound());
    CHECK(*measured.measure.bound() == Approx(.07));
  }
}

TEST_CASE("a tick in which a script of the node decides is no tick of its measures") {
  // `while` halts it in tick 1 and skips it then; the Script ends with tick 0.
  const Measured halted(
      "Sequence[memory=true](Script[code=k:=0] Parallel[success_count=2]("
      "ParallelRelative[delta=1 while=k<1](a b) Script[code=k:=k+1] w))",
      "a+.2 b+.1 w=RRRRS");
  CHECK(halted.ticks == 5);
  CHECK(halted.measure.distance().samples() == 1);
  CHECK(halted.measure.largest_spread() == 0);
  const Measured decided("Repeat[times=3](ParallelAbsolute[barriers=.5 success_if=true](a b))",
                         "a+.2 b+.1");
  CHECK(decided.measure.distance().samples() == 0);
}

TEST_CASE("a child that succeeds while an ancestor ends its node has its last step") {
  for (const char* node : {"ParallelRelative[delta=1]", "ParallelAbsolute[barrier_count=0]"}) {
    const Measured measured("Parallel(" + std::string(node) + "(a b) c)", "a+.1,.9 b+.1 c=RF");
    CHECK(measured.ticks == 2);
    CHECK(measured.measure.step_length() == Approx(.9));
  }
  // The other one keeps what it reported.
  const Measured early(
      "Parallel(Sequence[memory=true](ParallelRelative[delta=1 success_count=1](a "
      "b) w) c)",
      "a+.1,.9 b+.1 w=R c=RF");
  CHECK(early.measure.step_length() == Approx(.9));
}

}  // namespace
}  // namespace lockstep::host
