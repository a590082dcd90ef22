#include <catch2/catch.hpp>

#include "engine/synchronized.h"
#include "support/scripted_run.h"
#include "support/synchronized_trace.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr SynchronizedTrace kAcross[] = {
  {"X1", "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5;1]",
   "a+.1 b+.3", "12 12 1- 1- 1- 12 12 1. 1. 1.", 2.10},
  {"X2 wait",
   "Parallel(Sequence[memory=true](a SyncProgress[barrier=g](b)) SyncProgress[barrier=g](c)) "
   "barrier[name=g barriers=.5]",
   "a+.25 b+.2 c+.2", "1.3 1.3 1.3 12- .2- .2- .23 .23", 1.8, "0,0 0,.2 0,.4 0,.6 .2,.6 .4,.6 .6,.6 .8,.8"},
  {"X2 ignore",
   "Parallel(Sequence[memory=true](a SyncProgress[barrier=g](b)) SyncProgress[barrier=g](c)) "
   "barrier[name=g barriers=.5 idle=ignore]",
   "a+.25 b+.2 c+.2", "1.3 1.3 1.3 123 .2- .2- .23 .2.", 1.4},
  {"R1 across branches",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g delta=.2]",
   "a+.1 b+.3", "12 12 1- 1- 12 1- 1- 12 1. 1.", 2.30},
  {"A2t across branches",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5;1 at_barrier=tick]",
   "a+.1 b+.25", "12 12 12 1- 1- 12 1. 1. 1. 1.", 2.50},
};

constexpr TickRow kMemberRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"returns what its child returns",
   "Parallel[failure_count=2](SyncProgress[barrier=g](a) Inverter(SyncProgress[barrier=g](b))) barrier[name=g barriers=]",
   "a=RS b=RF", "R[a b] S[a b]"},
  {"a held member is Running, and its child is paused once",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1R.1R.5R.6 b=R.7", "R[a b] R[a] pause[b] R[a] R[a b] resume[b]"},
  {"reads progress also from a held child, and ticks it when it falls below the barrier",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1 b=R~0,.6,.6,.3", "R[a b] R[a] pause[b] R[a] R[a b] resume[b]"},
  {"takes one snapshot before the root is ticked, whatever comes first in the tree",
   "Sequence(Parallel(SyncProgress[barrier=g](a) Delay[seconds=0](SyncProgress[barrier=g](b)))) barrier[name=g barriers=.5]",
   "a=R.4R.6 b=R.5", "R[a b] R[a] pause[b] R[a b] resume[b]"},
  {"a member that was never reached counts as 0",
   "Parallel(Sequence[memory=true](x SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b)) barrier[name=g delta=.5]",
   "x=RRS a=R.4 b=R.6", "R[x b] R[x] pause[b] R[x a] R[a b] resume[b]"},
  {"idle=ignore: it does not count, and holds nobody",
   "Parallel(Sequence[memory=true](x SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b)) barrier[name=g delta=.5 idle=ignore]",
   "x=RRS a=R.4R.1 b=R.6R.8", "R[x b] R[x b] R[x a b] R[a b] R[a] pause[b]"},
  {"asks a guard in every tick and never holds it",
   "Parallel(SyncProgress[barrier=g](c?) SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "c=SSSF a=R.1 b=R.6", "R[c a b] R[c a] pause[b] R[c a] F[c a] halt[a b]"},
  {"of a guard only the last result counts",
   "Parallel[success_count=2 failure_count=2](SyncProgress[barrier=g](c?) SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "c=SFSS a=R.6 b=R.6", "R[c a b] R[c a b] R[c] pause[a b] R[c a b] resume[a b]"},
  {"a success counts until the common ancestor begins again, also when the member is ticked again",
   "Parallel(Sequence(SyncProgress[barrier=g](a) x) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=S x=R b=R.7", "R[a x b] R{start a, tick a, tick x, tick b}"},
  {"the common ancestor begins again: so does the barrier",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a+.25 b+.5",
   "R[a b] R[a] pause[b] R[a b] resume[b] S[a] R[a b] R[a] pause[b] R[a b] resume[b] S[a]"},
  {"nobody waits for a member that failed for good",
   "Parallel[success_count=1 failure_count=2](SyncProgress[barrier=g](a) SyncProgress[barrier=g](b) SyncProgress[barrier=g](c)) barrier[name=g barriers=.5]",
   "a=R.1F b=R.4R.6 c=R.7", "R[a b c] R[a b] pause[c] R[b c] resume[c]"},
  {"nobody waits for it either when a decorator turned the failure into a success",
   "Parallel(ForceSuccess(SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1F b=R.7", "R[a b] R[a] pause[b] R[b] resume[b]"},
  {"the others wait for one that is tried again",
   "Parallel(Retry[attempts=2](SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1FR.1 b=R.7", "R[a b] R[a] pause[b] R{start a, tick a}"},
  {"X4: a parallel that is begun again latches nobody for good",
   "Parallel(Retry[attempts=1000000](Parallel(SyncProgress[barrier=g](a))) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.01R.02R.03FR.01R.02R.03F b=R.1R.2R.3R.4R.5R.6",
   "R[a b] R[a b] R[a b] R[a b] R{start a, tick a, tick b} R[a] pause[b] R[a] R[a] R{start a, tick a}"},
  {"X4, idle=ignore: what has failed is not idle",
   "Parallel(Retry[attempts=1000000](Parallel(SyncProgress[barrier=g](a))) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5 idle=ignore]",
   "a=R.01R.02R.03FR.01R.02R.03F b=R.1R.2R.3R.4R.5R.6",
   "R[a b] R[a b] R[a b] R[a b] R{start a, tick a, tick b} R[a] pause[b] R[a] R[a] R{start a, tick a}"},
  {"nobody waits for it below a parallel that is begun once",
   "Parallel(Inverter(Parallel[success_count=1 failure_count=2](SyncProgress[barrier=g](a) x)) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1F x=R... b=R.7", "R[a x b] R[a x] pause[b] R[x b] resume[b]"},
  {"the others wait where the parallel may be begun again: Repeat",
   "Parallel(Repeat(Parallel[success_count=1 failure_count=2](SyncProgress[barrier=g](a) x)) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1F x=R... b=R.7", "R[a x b] R[a x] pause[b] R[x] R[x]"},
  {"the others wait where the parallel may be begun again: memory=false",
   "Parallel[memory=false](Parallel[success_count=1 failure_count=2](SyncProgress[barrier=g](a) x) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1F x=R... b=R.7", "R[a x b] R[a x] pause[b] R[x] R[x]"},
  {"the others wait where the parallel may be begun again: a script may halt it",
   "Sequence[memory=true](Script[code=y:=1] Parallel(Parallel[success_count=1 failure_count=2 while=y==1](SyncProgress[barrier=g](a) x) SyncProgress[barrier=g](b))) barrier[name=g barriers=.5]",
   "a=R.1F x=R... b=R.7", "R[a x b] R[a x] pause[b] R[x] R[x]"},
  {"nobody waits for it below the last child behind conditions",
   "Parallel(Sequence(c? Parallel[success_count=1 failure_count=2](SyncProgress[barrier=g](a) x)) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "c=S... a=R.1F x=R... b=R.7", "R[c a x b] R[c a x] pause[b] R[c x b] resume[b]"},
  {"the others wait where an action comes before it in every tick",
   "Parallel(Sequence(z Parallel[success_count=1 failure_count=2](SyncProgress[barrier=g](a) x)) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "z=S... a=R.1F x=R... b=R.7", "R[z a x b] R{start z, tick z, tick a, tick x, pause b} R{start z, tick z, tick x}"},
  {"the others wait where a condition before it has a script",
   "Sequence[memory=true](Script[code=y:=1] Parallel(Sequence(Check[code=y==1 skip_if=y==2] Parallel[success_count=1 failure_count=2](SyncProgress[barrier=g](a) x)) SyncProgress[barrier=g](b))) barrier[name=g barriers=.5]",
   "a=R.1F x=R... b=R.7", "R[a x b] R[a x] pause[b] R[x] R[x]"},
  {"nobody waits for it below a branch",
   "Parallel(IfThenElse(c? Parallel[success_count=1 failure_count=2](SyncProgress[barrier=g](a) x)) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "c=S a=R.1F x=R... b=R.7", "R[c a x b] R[a x] pause[b] R[x b] resume[b]"},
  {"the others wait where a skipped branch begins the condition again",
   "Parallel(IfThenElse(Parallel[success_count=1 failure_count=2](SyncProgress[barrier=g](a) x) y) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1FR.1 x=RRRSR y=K b=R.7",
   "R[a x b] R[a x] pause[b] R[x] R[x y] R{start a, tick a, start x, tick x, resume b, tick b} R[a x] pause[b]"},
  {"nobody waits for a member that was halted for good",
   "Parallel[success_count=1 failure_count=2](Parallel(SyncProgress[barrier=g](a) x) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1R.2 x=RF b=R.7", "R[a x b] R[a x] halt[a] pause[b] R[b] resume[b]"},
  {"a member that never began is idle, also below what has ended for good",
   "Parallel[success_count=1 failure_count=2](Sequence[memory=true](x SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R x=RF b=R.7", "R[x b] R[x] pause[b] R[]"},
  {"a member in what a script skips is left out",
   "Sequence[memory=true](Script[code=y:=1] Parallel(Sequence[memory=true skip_if=y==1](SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b))) barrier[name=g barriers=.5]",
   "a=R b=R.7R.8R.9S", "R[b] R[b] R[b] S[b]"},
  {"a script that decides for a member decides for the barrier",
   "Sequence[memory=true](Script[code=y:=1] Parallel[success_count=2 failure_count=2](SyncProgress[barrier=g success_if=y==1](a) SyncProgress[barrier=g failure_if=y==1](x) SyncProgress[barrier=g](b))) barrier[name=g barriers=.5]",
   "a=R x=R b=R.7R.8S", "R[b] R[b] S[b]"},
  {"a barrier at 0: members that are reached in one tick begin together in the next",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=0]",
   "a=RS b=RRS", "R[] R[a b] R[a b] S[b]"},
  {"a barrier at 0: no member begins before the last one is reached, and that one does not go first",
   "Parallel(SyncProgress[barrier=g](a) Sequence[memory=true](x SyncProgress[barrier=g](b))) barrier[name=g barriers=0;.5]",
   "a=R.1R.6 x=RS b=R.1R.2", "R[x] R[x] R[a b] R[a b] R[b] pause[a]"},
  {"a barrier at 0: a member that begins again waits one tick, and nobody waits for it at 0 that has begun",
   "Parallel(Retry[attempts=2](SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b)) barrier[name=g barriers=0]",
   "a=RFR b=R", "R[] R[a b] R[a b] R[b] R{start a, tick a, tick b}"},
  {"a barrier at 0: who has passed, is skipped or idle and ignored, is not waited for",
   "Sequence[memory=true](Script[code=y:=1] Parallel(SyncProgress[barrier=g success_if=y==1](a) SyncProgress[barrier=g skip_if=y==1](x) "
   "Sequence[memory=true](z SyncProgress[barrier=g](b)))) barrier[name=g barriers=0]",
   "a=R x=R z=RRS b=RS", "R[z] R[z] R[z] R[b] S[b]"},
  {"a barrier at 0, idle=ignore: only a failed member is waited for",
   "Parallel(Retry[attempts=2](SyncProgress[barrier=g](a)) Sequence[memory=true](x SyncProgress[barrier=g](b))) barrier[name=g barriers=0 idle=ignore]",
   "a=FR x=S b=R", "R[a x b] R[b] R{start a, tick a, tick b}"},
  {"a barrier at 0: a guard that failed is waited for, and is never held",
   "Parallel[success_count=2 failure_count=2](SyncProgress[barrier=g](c?) SyncProgress[barrier=g](a) x) barrier[name=g barriers=0]",
   "c=FFS... a=R x=R", "R[c x] R[c x] R[c x] R[c a x]"},
  {"hold=between looks at the barrier before a Sequence in a member begins its next child",
   "Parallel(SyncProgress[barrier=g](Sequence[memory=true](a b)) SyncProgress[barrier=g](c)) barrier[name=g barriers=.5 hold=between]",
   "a=S b=R c=R.1R.5", "R[a c] R[c] R[b c]"},
  {"a barrier at 0: at_barrier does not concern it",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=0 at_barrier=tick]",
   "a=R b=R", "R[] R[a b]"},
  {"a barrier at 0: a member that waits to begin neither owns resources nor asks for them",
   "Parallel(UseResources[pool=p resources=A keep=true](SyncProgress[barrier=g](a)) UseResources[pool=p resources=A](x) "
   "Sequence[memory=true](z SyncProgress[barrier=g](b))) barrier[name=g barriers=0] resources[name=p]",
   "a=RRS x=R z=RS b=R...", "R[x z] R[x z] R{start a, tick a, pause x, start b, tick b} R[a b]"},
  {"a barrier at 0: the common ancestor begins again, and the members wait again",
   "Repeat(Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b))) barrier[name=g barriers=0]",
   "a=SS b=SS", "R[] R[a b] R[] R[a b]"},
  {"a barrier at 0: a parallel has no use for it",
   "ParallelAbsolute[barriers=0;.5](a b)",
   "a=R.5 b=R.1", "R[a b] R[b] pause[a]"},
  {"a halted member that was held is not resumed",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1R.1F b=R.6", "R[a b] R[a] pause[b] F[a] halt[b]"},
  {"a member in a held subtree is not reached; the others still wait for it",
   "ParallelAbsolute[barriers=.5](x Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b))) barrier[name=g delta=0]",
   "x=R.1 a=R.6 b=R.6", "R[x a b] R[x] pause[a b]"},
  {"two barriers hold independently of each other",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=h](b) SyncProgress[barrier=g](c) SyncProgress[barrier=h](d)) barrier[name=g delta=.1] barrier[name=h delta=.5]",
   "a=R.1 b=R.1 c=R.4 d=R.4", "R[a b c d] R[a b d] pause[c]"},
  {"a member may be inside one of another barrier",
   "Parallel(SyncProgress[barrier=g](SyncProgress[barrier=h](a)) SyncProgress[barrier=h](b) SyncProgress[barrier=g](c)) barrier[name=g delta=.1] barrier[name=h delta=.1]",
   "a=R.3 b=R.1 c=R.1", "R[a b c] R[b c] pause[a]"},
  {"a member that is ahead by delta is ticked",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g delta=0]",
   "a=R0 b=R1e-9", "R[a b] R[a b]"},
  {"ends the run when a member's progress is not a number, and ticks nobody after that",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R b=R<nan>", "R[a b] X{halt a, halt b}=b"},
};
// clang-format on

std::string barrier_fault(ScriptedRun& run) {
  const Fault* fault = run.ticker().fault();
  return fault == nullptr ? "" : run.tree().path(fault->node) + ": " + fault->message;
}

constexpr std::string_view kFromEntry =
    "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g delta={d}]";

}  // namespace

TEST_CASE("SyncProgress: worked traces") {
  check_traces(kAcross);
}

TEST_CASE("SyncProgress") {
  check_rows(kMemberRows);
}

TEST_CASE("SyncProgress: the limits of a barrier may come from entries") {
  ScriptedRun run(kFromEntry, "a=R.1... b=R.6...");
  run.set("d", 1.0);
  run.tick(from_seconds(0));
  run.tick(from_seconds(0.1));
  CHECK_FALSE(run.ticker().held(4));
  run.set("d", 0.2);
  run.tick(from_seconds(0.2));
  CHECK(run.ticker().held(4));
  CHECK(limit(run.ticker(), 5) == 0.2);
  CHECK(barrier_fault(run).empty());
}

TEST_CASE("SyncProgress: the tree may write the limits before a member runs") {
  constexpr std::string_view kWrites = "Sequence[memory=true](Script[code=d:=0.2] Parallel(%) x)";
  const auto trace_of = [](std::string tree) {
    ScriptedRun run(tree, "a=R.1R.2R.3S b=R.6S x=RRS");
    std::string trace;
    for (int tick = 0; tick < 9; ++tick) {
      trace += std::to_string(static_cast<int>(run.tick(from_seconds(0.1 * tick))));
      CHECK(barrier_fault(run).empty());
      for (const LeafNode& leaf : run.tree().leaves) {
        trace += run.ticker().ticked(leaf.node) ? '1' : '-';
      }
    }
    return trace;
  };
  const auto with = [&](std::string_view parallel) {
    return std::string(kWrites).replace(kWrites.find("Parallel(%)"), 11, parallel);
  };
  CHECK(trace_of(with("ParallelRelative[delta={d}](a b)")) ==
        trace_of(with("Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b))") +
                 " barrier[name=g delta={d}]"));
}

TEST_CASE("SyncProgress: a limit without a value is a fault once a member runs, and named") {
  ScriptedRun run(kFromEntry, "a=R.1... b=R.6...");
  CHECK(run.tick(from_seconds(0)) == Status::Running);
  CHECK(barrier_fault(run).empty());
  run.tick(from_seconds(0.1));
  CHECK(barrier_fault(run) == "Test/g: 'delta' has no value: nothing has written the entry '{d}'");

  ScriptedRun barriers("ParallelAbsolute[barriers={d}](a b)", "a=R.1... b=R.6...");
  barriers.tick(from_seconds(0));
  CHECK(barrier_fault(barriers).ends_with(
      "'barriers' has no value: nothing has written the entry '{d}'"));
}

TEST_CASE("SyncProgress: nobody is held, and there is no limit, before the limits are written") {
  ScriptedRun run(kFromEntry, "a=R b=R");
  run.tick(from_seconds(0));
  CHECK(limit(run.ticker(), 5) == std::numeric_limits<double>::infinity());
  ScriptedRun constant(
      "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g delta=.2]",
      "a=R b=R");
  constant.tick(from_seconds(0));
  CHECK(limit(constant.ticker(), 5) == 0.2);
}

TEST_CASE("SyncProgress: a halted member is not held any more when no member runs") {
  ScriptedRun run(
      "Parallel(Retry[attempts=3](Timeout[seconds=.2 on_failure=d:=5](SyncProgress[barrier=g](a)))"
      " SyncProgress[barrier=g](b)) barrier[name=g delta={d}]",
      "a=R.7... b=R.1R.1S");
  run.set("d", 0.2);
  const NodeIndex member = 3;
  run.tick(from_seconds(0));
  run.tick(from_seconds(0.1));
  CHECK(run.ticker().held(member + 1));
  run.tick(from_seconds(0.2));  // a is halted, b succeeds, and the limit cannot be read
  CHECK(run.ticker().status(member) == Status::Idle);
  run.tick(from_seconds(0.3));
  CHECK(run.ticker().ticked(member + 1));
}

TEST_CASE("SyncProgress: an entry that the barrier does not accept is its fault") {
  ScriptedRun run(kFromEntry, "a=R.1... b=R.6...");
  run.set("d", 1.0);
  run.tick(from_seconds(0));
  run.set("d", 2.0);
  CHECK(run.tick(from_seconds(0.1)) == Status::Running);
  CHECK(barrier_fault(run).starts_with("Test/g: 2 is outside the range of 'delta'"));
  CHECK(run.ticker().status(0) == Status::Idle);

  ScriptedRun goes_on(kFromEntry, "a=R.1... b=R.6...", FaultPolicy::Fail);
  goes_on.set("d", 1.0);
  goes_on.tick(from_seconds(0));
  goes_on.set("d", 2.0);
  goes_on.events.clear();
  CHECK(goes_on.tick(from_seconds(0.1)) == Status::Failure);
  CHECK(goes_on.events == EventLog{{Call::Halt, 0}, {Call::Halt, 1}});
  CHECK(goes_on.ticker().take_tolerated().size() == 1);
  goes_on.set("d", 0.2);
  CHECK(goes_on.tick(from_seconds(0.2)) == Status::Running);
}

TEST_CASE(
    "SyncProgress: the tick in which its common ancestor is made to fail is none of the barrier") {
  ScriptedRun run(
      "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g delta=1]",
      "a=R b=R");
  run.tick(from_seconds(0));
  run.ticker().fail_next(0);
  CHECK(run.tick(from_seconds(0.1)) == Status::Failure);
  CHECK_FALSE(run.ticker().ticked(run.tree().groups[0].node));
}

TEST_CASE("SyncProgress: a barrier whose guard fails again has not succeeded") {
  ScriptedRun run(
      "Parallel[success_count=3 failure_count=2](SyncProgress[barrier=g](a) "
      "SyncProgress[barrier=g](c?) x y) barrier[name=g delta=1]",
      "a=S x=R y=R c=SFS");
  const NodeIndex barrier = run.tree().groups[0].node;
  for (const Status expected : {Status::Success, Status::Running, Status::Success}) {
    run.tick(from_seconds(0));
    CHECK(run.ticker().status(barrier) == expected);
  }
}

TEST_CASE("SyncProgress: a barrier runs with the common ancestor, and succeeds with its members") {
  ScriptedRun run(
      "Sequence[memory=true](x Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) y) "
      "barrier[name=g delta=1]",
      "x=RS a=RS b=RRS y=RRS");
  const NodeIndex barrier = run.tree().groups[0].node;
  CHECK(run.tree().groups[0].ancestor == 2);
  auto after_tick = [&, tick = 0]() mutable {
    run.tick(from_seconds(0.1 * tick++));
    return run.ticker().status(barrier);
  };
  CHECK(after_tick() == Status::Idle);  // x
  CHECK_FALSE(run.ticker().ticked(barrier));
  CHECK(after_tick() == Status::Running);
  CHECK(run.ticker().ticked(barrier));
  CHECK(after_tick() == Status::Running);
  CHECK(after_tick() == Status::Success);
  CHECK(after_tick() == Status::Idle);  // y
  CHECK_FALSE(run.ticker().ticked(barrier));
}

}  // namespace lockstep::host::test
