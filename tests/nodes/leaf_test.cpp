#include <catch2/catch.hpp>

#include "support/scripted_run.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kLeafRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"an activation is start, then a tick in each tick",
   "a", "a=RRS", "R{start a, tick a} R{tick a} S{tick a}"},
  {"the next tick after a result starts it again",
   "a", "a=SF", "S{start a, tick a} F{start a, tick a}"},
  {"a halt ends the activation",
   "a", "a=R", "R{start a, tick a} stop halt[a] R{start a, tick a}"},
  {"a leaf that does not run is not halted",
   "Sequence(a)", "a=S", "S[a] stop"},
  {"an action with nothing but tick can be started, halted, paused and resumed",
   "Sequence(c? ParallelAbsolute[barriers=.5](a Sequence[memory=true](AlwaysSuccess b[bare])))",
   "c=SSSSF a=R.1R.1R.6 b=R", "R[c a b] R[c a] R[c a] R[c a b] F[c] halt[a]"},
  {"an action with nothing but tick has progress 0 until it succeeds",
   "a[bare]", "a=R.5S", "R[a]=0 S[a]=1"},
  {"progress is clamped to [0, 1]",
   "a", "a=R-2R.5R2", "R[a]=0 R[a]=.5 R[a]=1"},
  {"a failed leaf has progress 0",
   "a", "a=R.5F", "R[a]=.5 F[a]=0"},
  {"a condition has progress 1 when it holds, else 0",
   "c?", "c=SF", "S[c]=1 F[c]=0"},

  {"an error in tick ends the run; the leaf is halted",
   "a", "a=RX", "R[a] X{tick a, halt a}=a"},
  {"an exception in tick ends the run; the leaf is halted",
   "a", "a=RT", "R[a] X{tick a, halt a}=a"},
  {"an error in its first tick halts a leaf as well",
   "a", "a=X", "X{start a, tick a, halt a}=a"},
  {"an error in start: the leaf is neither ticked nor halted",
   "Parallel(a b)", "a=R b=x", "X{start a, tick a, start b, halt a}=b"},
  {"an exception in start: the leaf is neither ticked nor halted",
   "Parallel(a b)", "a=R b=t", "X{start a, tick a, start b, halt a}=b"},
  {"a leaf or a condition may be skipped: its activation ends, and it is not halted",
   "Fallback(c? a)", "c=FK a=RK", "R{start c, tick c, start a, tick a} K{start c, tick c, tick a} "
   "K{start c, tick c, start a, tick a}"},
  {"a status out of range is a fault",
   "a", "a=B", "X{start a, tick a, halt a}=a"},
  {"idle is no status that a leaf may return",
   "a", "a=I", "X{start a, tick a, halt a}=a"},
  {"a condition that returns Running is at fault",
   "Sequence(c? a)", "c=R a=R", "X{start c, tick c, halt c}=c"},
  {"after a fault nothing is ticked, and the running leaves are halted from the left",
   "Parallel(a b c)", "a=R b=RX c=R", "R[a b c] X{tick a, tick b, halt a, halt b, halt c}=b"},
  {"a control node that the fault makes stop leaves the halts to the end of the run",
   "Parallel(a Sequence(b c))", "a=R b=SX c=R",
   "R[a b c] X{tick a, start b, tick b, halt a, halt b, halt c}=b"},
  {"an error in halt is a fault; the leaf is not halted again",
   "Parallel(a Fallback(b? c))", "a=R b=FS c=R!halt",
   "R[a b c] X{tick a, start b, tick b, halt c, halt a}=c"},
  {"an exception in halt is a fault; the leaf is not halted again",
   "Fallback(b? c)", "b=FS c=R^halt", "R[b c] X{start b, tick b, halt c}=c"},
  {"a halt at the end of the run that goes wrong does not stop the others",
   "Parallel(a b c)", "a=R b=R^halt c=RX", "R[a b c] X{tick a, tick b, tick c, halt a, halt b, halt c}=c!b"},
  {"an error in pause is a fault",
   "ParallelAbsolute[barriers=.5](a b c)", "a=R.1 b=R.6!pause c=R",
   "R[a b c] X{tick a, pause b, halt a, halt b, halt c}=b"},
  {"an error in resume is a fault; the leaf is not ticked",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1R.6 b=R.6!resume",
   "R[a b] R[a] pause[b] X{tick a, resume b, halt a, halt b}=b"},
  {"a progress of -0 is 0: those that are ahead wait for it",
   "ParallelAbsolute[barriers=.5](a b)", "a=R-0 b=R.6", "R[a b] R[a] pause[b] R[a]"},
};

struct FaultRow {
  std::string_view script, message;
};

constexpr FaultRow kFaults[] = {
  {"X", "error of the script"},
  {"x", "error of the script"},
  {"T", "threw an exception: thrown by the script"},
  {"t", "threw an exception: thrown by the script"},
  {"B", "returned status 7, expected one of lockstep/leaf.h"},
  {"I", "returned status 0, expected one of lockstep/leaf.h"},
};
// clang-format on

}  // namespace

TEST_CASE("plugin leaves: life cycle and faults") {
  check_rows(kLeafRows);
}

TEST_CASE("a fault says what the leaf did") {
  for (const FaultRow& row : kFaults) {
    ScriptedRun run("Sequence(a)", "a=" + std::string(row.script));
    run.tick(Nanoseconds(0));
    REQUIRE(run.ticker().fault() != nullptr);
    CHECK(run.ticker().fault()->node == 1);
    CHECK(run.ticker().fault()->message == row.message);
  }
}

TEST_CASE("a progress out of range is noted with its value, once for each leaf") {
  ScriptedRun run("ParallelRelative[delta=1](a b c)", "a=R42R7R-3 b=R.5R-.25 c=R1.0000000001R0");
  const auto noted = [&run] {
    std::vector<std::pair<NodeIndex, double>> all;
    for (const OutOfRange& it : run.ticker().out_of_range()) all.emplace_back(it.node, it.reported);
    return all;
  };
  using Noted = std::vector<std::pair<NodeIndex, double>>;
  run.tick(Nanoseconds(0));
  CHECK(noted().empty());  // nobody has asked yet
  run.tick(Nanoseconds(1));
  CHECK(noted() == Noted{{1, 42}});
  for (int tick = 2; tick < 5; ++tick) run.tick(Nanoseconds(tick));
  CHECK(noted() == Noted{{1, 42}, {2, -0.25}});
  run.restart();
  CHECK(noted().empty());
  run.tick(Nanoseconds(0));
  run.tick(Nanoseconds(1));
  CHECK(noted() == Noted{{1, 42}});
}

namespace {

std::vector<std::pair<NodeIndex, double>> went_on(ScriptedRun& run, int ticks) {
  for (int tick = 0; tick < ticks; ++tick) run.tick(Nanoseconds(tick));
  std::vector<std::pair<NodeIndex, double>> all;
  for (const WentOn& it : run.ticker().went_on()) all.emplace_back(it.node, it.to - it.from);
  return all;
}

}  // namespace

TEST_CASE("a leaf that goes on while it is held is noted, once in a run") {
  using Noted = std::vector<std::pair<NodeIndex, double>>;
  ScriptedRun run("ParallelAbsolute[barriers=.5](a b)", "a=R.1 b=R~0,.6,.75,.8125,.9");
  CHECK(went_on(run, 3).empty());  // one rise may be the answer to the last tick
  run.restart();
  const auto noted = went_on(run, 10);
  REQUIRE(noted.size() == 1);
  CHECK(noted[0].first == 2);
  CHECK(noted[0].second > 0.2);
  run.restart();
  CHECK(went_on(run, 10).size() == 1);

  ScriptedRun pool(
      "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)) "
      "resources[name=p increment=0]",
      "a=R~0,.1,.2,.3 b=R~0,.1,.2,.3");
  CHECK(went_on(pool, 10).empty());  // who is never held may go on
  ScriptedRun taken(
      "Parallel(UseResources[pool=p resources=A](a) Sequence(UseResources[pool=p resources=A](b))) "
      "resources[name=p increment=1]",
      "a=R~0,.1,.2,.3,.4,.5 b=R~0");
  CHECK(went_on(taken, 10).empty());  // held for a tick at a time

  for (const char* still : {"a=R.1 b=R.6", "a=R.1 b=R~0,.6,.6,.7,.7",
                            "a=R.1 b=R~0,.6,.601,.602,.603,.6,.602,.604", "a=R.1 b=R~0,.6,.5,.4"}) {
    INFO(still);
    ScriptedRun held("ParallelAbsolute[barriers=.5](a b)", still);
    CHECK(went_on(held, 12) == Noted{});
  }
}

TEST_CASE("the first fault of a run is kept") {
  ScriptedRun run("a", "a=X^halt");
  run.tick(Nanoseconds(0));
  REQUIRE(run.ticker().fault() != nullptr);
  CHECK(run.ticker().fault()->message == "error of the script");
}

}  // namespace lockstep::host::test
