// In which ticks breakpoints are reached.
#include "run/breakpoints.h"

#include <catch2/catch.hpp>
#include <string>

#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

using When = Breakpoint::When;

// A letter for each tick: 'x' where it is reached.
std::string ticks_of(std::string_view tree, std::string_view leaves, NodeIndex node, When when,
                     int ticks) {
  ScriptedRun run(tree, leaves);
  Breakpoints breakpoints;
  breakpoints.set(run.ticker(), {node, when});
  std::string reached;
  for (int tick = 0; tick < ticks; ++tick) {
    run.tick(tick * std::chrono::milliseconds(100));
    const auto it = breakpoints.reached(run.ticker());
    if (it) CHECK(*it == Breakpoint{node, when});
    reached += it ? 'x' : '.';
  }
  return reached;
}

}  // namespace

TEST_CASE("a breakpoint is reached when a node begins") {
  CHECK(ticks_of("Sequence(a b)", "a=RRS b=RRS", 2, When::Begins, 5) == "..x..");
  CHECK(ticks_of("Sequence(g? b)", "g=SSS b=RRR", 1, When::Begins, 3) == "x..");
  CHECK(ticks_of("Repeat[times=3](a)", "a=RSRSRS", 1, When::Begins, 6) == "x.x.x.");
}

TEST_CASE("a breakpoint is reached when a node completes, also with its ancestors") {
  CHECK(ticks_of("Sequence(a b)", "a=RRS b=RRS", 1, When::Completes, 5) == "..x..");
  CHECK(ticks_of("Sequence(a b)", "a=RRF b=RRS", 1, When::Completes, 3) == "..x");
  CHECK(ticks_of("Repeat[times=2](Sequence(a))", "a=RSRS", 2, When::Completes, 4) == ".x.x");
}

// Of each second tick there is nothing to tell: the node stands as it was.
TEST_CASE(
    "a breakpoint is reached each time that a node completes anew, also with the same result") {
  constexpr const char* kTree = "Repeat[times=3](Sequence[memory=true](a b))";
  for (const When when : {When::Begins, When::Completes, When::Succeeds}) {
    CHECK(ticks_of(kTree, "a=SSS b=RSRSRS", 2, when, 6) == "x.x.x.");
  }
  CHECK(ticks_of("Sequence(g? b)", "g=SSSS b=RRRR", 1, When::Succeeds, 4) == "x...");
  CHECK(ticks_of("Sequence(g? b)", "g=SSFS b=RRRR", 1, When::Succeeds, 3) == "x..");
}

TEST_CASE("a breakpoint is reached when a child comes to a barrier, or all have passed it") {
  constexpr const char* kTree = "ParallelAbsolute[barriers=.5;1](a b)";
  CHECK(ticks_of(kTree, "a+.25 b+.5", 0, When::Barrier, 4) == ".xx.");
  CHECK(ticks_of(kTree, "a+.25 b+.25", 0, When::Barrier, 4) == "..x.");
  CHECK(ticks_of("ParallelRelative[delta=.3](a b)", "a+.1 b+.3", 0, When::Barrier, 3) == "..x");
}

TEST_CASE("a breakpoint that was removed is not reached") {
  ScriptedRun run("Sequence(a)", "a=RS");
  Breakpoints breakpoints;
  breakpoints.set(run.ticker(), {1, When::Begins});
  breakpoints.remove({1, When::Begins});
  run.tick(Nanoseconds(0));
  CHECK_FALSE(breakpoints.reached(run.ticker()));
}

}  // namespace lockstep::host::test
