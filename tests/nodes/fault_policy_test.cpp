// What a tree does when a leaf breaks its contract and the run goes on (FaultPolicy::Fail).
#include <catch2/catch.hpp>

#include "support/scripted_run.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kFaultPolicyRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"an error in tick: the leaf is halted and its tick is a Failure; the next activation starts it anew",
   "a", "a=RXRS", "R{start a, tick a} F{tick a, halt a}!a R{start a, tick a} S{tick a}"},
  {"an error in the first tick: the same",
   "a", "a=XS", "F{start a, tick a, halt a}!a S{start a, tick a}"},
  {"an exception in tick: the same",
   "a", "a=RTS", "R{start a, tick a} F{tick a, halt a}!a S{start a, tick a}"},
  {"a status out of range: the same",
   "a", "a=RBS", "R{start a, tick a} F{tick a, halt a}!a S{start a, tick a}"},
  {"idle as a status: the same",
   "a", "a=IS", "F{start a, tick a, halt a}!a S{start a, tick a}"},
  {"a condition that returns Running: the same",
   "c?", "c=RS", "F{start c, tick c, halt c}!c S{start c, tick c}"},
  {"an error in start: a Failure without tick and halt",
   "a", "a=x", "F{start a}!a F{start a}!a"},
  {"an exception in start: a Failure without tick and halt",
   "a", "a=St", "S{start a, tick a} F{start a}!a"},
  {"nothing is left to halt at the end of the run after a Failure",
   "a", "a=X", "F{start a, tick a, halt a}!a stop"},
  {"a leaf with nothing but tick can fail as well",
   "a[bare]", "a=RXS", "R[a] F[a]!a S[a]"},

  {"an error in the halt after a fault is reported too and changes nothing",
   "a", "a=XS!halt", "F{start a, tick a, halt a}!a,a S{start a, tick a}"},
  {"an exception in the halt after a fault is reported too and changes nothing",
   "a", "a=BS^halt", "F{start a, tick a, halt a}!a,a S{start a, tick a}"},
  {"an error in halt is reported; the leaf is not halted again, and starts from its beginning",
   "Fallback(b? a)", "b=FSF a=RRS!halt",
   "R[b a] S{start b, tick b, halt a}!a R{start b, tick b, start a, tick a}"},
  {"an exception in halt is reported; the leaf is not halted again, and starts from its beginning",
   "Fallback(b? a)", "b=FSF a=RRS^halt",
   "R[b a] S{start b, tick b, halt a}!a R{start b, tick b, start a, tick a}"},
  {"errors in the halt at the end of the run: the first is the fault, all others are halted",
   "Parallel(a b c)", "a=R b=R!halt c=R^halt", "R[a b c] stop!c halt[a b c] X{}=b"},

  {"an error in resume: the leaf is not ticked but halted",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1R.6 b=R.6!resume",
   "R[a b] R{tick a, pause b} F{tick a, resume b, halt b, halt a}!b"},
  {"an error in pause: the leaf is halted and fails in that tick, without resume",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1 b=R.6!pause",
   "R[a b] F{tick a, pause b, halt b, halt a}!b"},
  {"an exception in pause: the same",
   "ParallelRelative[delta=.1](a b)", "a=R.1 b=R.6^pause",
   "R[a b] F{tick a, pause b, halt b, halt a}!b"},
  {"a Fallback in the held child goes on in that tick, and the next activation of the leaf starts anew",
   "ParallelAbsolute[barriers=.5](a Fallback(b d))", "a=R.1 b=R.6R!pause d=FR",
   "R[a b] F{tick a, pause b, halt b, start d, tick d, halt a}!b R[a b]"},
  {"what is as far as a barrier fails there, too: its progress need not fall",
   "ParallelAbsolute[barriers=.5](a Sequence[memory=true](d b))", "a=R.1 d=S b=R.2!pause",
   "R[a d b] F{tick a, pause b, halt b, halt a}!b"},
  {"a member of a barrier fails in that tick",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1 b=R.7!pause", "R[a b] F{tick a, pause b, halt b, halt a}!b"},
  {"a leaf that waits for resources fails in that tick",
   "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)) resources[name=p]",
   "a=R!pause b=R", "R[a] F{pause a, halt a, start b, tick b, halt b}!a"},
  {"one below it is halted in that tick, and fails when others in the child may begin",
   "Parallel(UseResources[pool=p resources=A](Fallback(a d)) UseResources[pool=p resources=A](b)) resources[name=p]",
   "a=R!pause b=R d=R", "R[a] R{pause a, halt a, start b, tick b}!a R{start d, tick d, pause b}"},
  {"progress that is not a number counts as 0; the leaf is halted in its next tick",
   "a", "a=RR<nan>RS", "R[a]=0 R[a]=0!a F{halt a} R{start a, tick a}"},

  {"a leaf at fault in progress is halted by its parent as any other, and starts anew",
   "Fallback(c? a)", "c=FSF a=R<nan>R",
   "R[c a]=0!a S{start c, tick c, halt a} R{start c, tick c, start a, tick a}"},

  {"a Fallback goes to the next child in the same tick",
   "Fallback(a b)", "a=RX b=RS", "R[a] R{tick a, halt a, start b, tick b}!a"},
  {"a Fallback with memory stays there",
   "Fallback[memory=true](a b)", "a=X b=RS", "R[a b]!a halt[a] S[b]"},
  {"a Sequence fails and ticks nothing further",
   "Sequence(a b)", "a=X b=S", "F[a]!a halt[a]"},
  {"a leaf of a Sequence that fails has its siblings halted as the law says",
   "Sequence(a b)", "a=SX b=R", "R[a b] F{start a, tick a, halt a, halt b}!a"},
  {"an Inverter makes it a Success",
   "Inverter(a)", "a=X", "S[a]!a halt[a]"},
  {"a Retry tries again",
   "Retry[attempts=2](a)", "a=XS", "R[a]!a halt[a] S{start a, tick a}"},
  {"a Parallel that may lose one goes on with the others",
   "Parallel[success_count=1 failure_count=2](a b)", "a=X b=RS",
   "R{start a, tick a, halt a, start b, tick b}!a S{tick b}"},
  {"a ParallelAbsolute does not wait for it: Failure, and the held siblings are halted",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1RX b=R.6", "R[a b] R[a] pause[b] F{tick a, halt a, halt b}!a"},
  {"a ParallelRelative does not wait for it: Failure, and the held siblings are halted",
   "ParallelRelative[delta=.1](a b)", "a=R.1RX b=R.6", "R[a b] R[a] pause[b] F{tick a, halt a, halt b}!a"},
  {"a ParallelAbsolute ticks a child whose progress is no number at once, and fails",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.6R b=R.1R<nan>",
   "R[a b] R{pause a, tick b} F{halt b, halt a}!b"},
  {"a ParallelRelative ticks a child whose progress is no number at once, and fails",
   "ParallelRelative[delta=0](a b)", "a=R.6 b=R<nan>", "R[a b] F{pause a, halt b, halt a}!b"},
  {"a leaf whose progress is no number is not paused any more: its next call is halt, in that tick",
   "ParallelRelative[delta=0](Sequence(d a) b)", "d=S a=R<nan> b=RRS",
   "R[d a b] F{start d, tick d, halt a, tick b, halt b}!a"},
  {"under a synchronized parallel a Fallback has the next child carry on, from progress 0",
   "ParallelAbsolute[barriers=.5](a Fallback[memory=true](b d))", "a=R.6 b=R.2X d=R.2R.7R",
   "R[a b] R{pause a, tick b, halt b, start d, tick d}!b R{tick d} R{resume a, tick a, tick d}"},
  {"several leaves at fault in one tick are reported in their order",
   "Fallback(a b d)", "a=X b=x d=T", "F{start a, tick a, halt a, start b, start d, tick d, halt d}!a,b,d"},
};
// clang-format on

}  // namespace

TEST_CASE("faults that the run goes on after") {
  check_rows(kFaultPolicyRows, FaultPolicy::Fail);
}

TEST_CASE("a fault that the run goes on after says what the leaf did and ends nothing") {
  ScriptedRun run("Fallback(a b)", "a=B b=R", FaultPolicy::Fail);
  run.tick(Nanoseconds(0));
  CHECK(run.ticker().fault() == nullptr);
  REQUIRE(run.ticker().tolerated().size() == 1);
  CHECK(run.ticker().tolerated()[0].node == 1);
  CHECK(run.ticker().tolerated()[0].message ==
        "returned status 7, expected one of lockstep/leaf.h");
}

TEST_CASE("a leaf at fault in progress reports 0 from then on and is not asked again") {
  ScriptedRun run("a", "a=R<nan>", FaultPolicy::Fail);
  run.tick(Nanoseconds(0));
  CHECK(run.ticker().progress(0) == 0.0);
  CHECK(run.ticker().progress(0) == 0.0);
  CHECK(run.ticker().take_tolerated().size() == 1);
  CHECK(run.ticker().tolerated().empty());
}

TEST_CASE("a fault of progress asked for before a tick is reported with that tick") {
  ScriptedRun run("a", "a=R<nan>", FaultPolicy::Fail);
  run.tick(Nanoseconds(0));
  run.ticker().progress(0);
  CHECK(run.tick(Nanoseconds(1)) == Status::Failure);
  CHECK(run.ticker().tolerated().size() == 1);
}

TEST_CASE("a run begun anew has forgotten the faults that it went on after") {
  ScriptedRun run("a", "a=R<nan>", FaultPolicy::Fail);
  run.tick(Nanoseconds(0));
  run.ticker().progress(0);
  run.restart();
  CHECK(run.ticker().tolerated().empty());
  CHECK(run.tick(Nanoseconds(0)) == Status::Running);
}

}  // namespace lockstep::host::test
