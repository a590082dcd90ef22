#include <catch2/catch.hpp>

#include "support/synchronized_trace.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr SynchronizedTrace kTraces[] = {
  {"A1",  "ParallelAbsolute[barriers=.5;1](a b)", "a+.1 b+.3",
   "12 12 1- 1- 1- 12 12 1. 1. 1.", 2.10},
  {"A2t", "ParallelAbsolute[barriers=.5;1 at_barrier=tick](a b)", "a+.1 b+.25",
   "12 12 12 1- 1- 12 1. 1. 1. 1.", 2.50},
  {"A2w", "ParallelAbsolute[barriers=.5;1](a b)", "a+.1 b+.25",
   "12 12 1- 1- 1- 12 12 1. 1. 1.", 1.50},
  {"A3",  "ParallelAbsolute[barriers=.3](a b)", "a+.2 b+.4",
   "12 1- 12 12 1.", 0.60},
  {"A4t", "ParallelAbsolute[barrier_count=4 at_barrier=tick](a b c)", "a+.1 b+.2 c+.5",
   "123 12- 1-- 123 1-. 12. 1-. 1-. 12. 1..", 6.00},
  {"A4w", "ParallelAbsolute[barriers=.25;.5;.75;1](a b c)", "a+.1 b+.2 c+.5",
   "123 12- 1-- 12- 1-- 123 1-. 1-. 12. 1..", 4.40},
  {"A5, progress that falls", "ParallelAbsolute[barriers=.3;.6;1](a b)", "a+.4,-.2,.3 b+.35",
   "12 12 1- 1- 12", 0.85},
};

constexpr TickRow kParallelAbsoluteRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"without barriers is a Parallel that waits for nobody",
   "ParallelAbsolute[barriers=](a b)", "a+.5 b+.25", "R[a b] R[a b] R[b] S[b]"},
  {"with barrier_count 0 has no barriers",
   "ParallelAbsolute[barrier_count=0](a b)", "a+.5 b+.25", "R[a b] R[a b] R[b] S[b]"},
  {"with barrier_count n has the barriers i/n",
   "ParallelAbsolute[barrier_count=2](a b)", "a+.25 b+.5",
   "R[a b] R[a] pause[b] R[a b] resume[b] S[a]"},
  {"at_barrier=wait holds a child that is exactly at the barrier",
   "ParallelAbsolute[barriers=.5 at_barrier=wait](a b)", "a=R.1 b=R.5", "R[a b] R[a] pause[b]"},
  {"at_barrier=tick ticks a child that is exactly at the barrier",
   "ParallelAbsolute[barriers=.5 at_barrier=tick](a b)", "a=R.1 b=R.5R.51",
   "R[a b] R[a b] R[a] pause[b]"},
  {"waits by default at the barrier",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1 b=R.5", "R[a b] R[a] pause[b]"},
  {"lets all go on when the last one has reached the barrier",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1R.5R.6 b=R.7", "R[a b] R[a] pause[b] R[a b] resume[b]"},
  {"a barrier at 1 holds a child that reports 1 and still runs",
   "ParallelAbsolute[barriers=1](a b)", "a=R.1 b=R1", "R[a b] R[a] pause[b]"},
  {"knows a barrier again that a sum of doubles only nearly reaches",
   "ParallelAbsolute[barriers=.8](a b)", "a=R.1 b+.1",
   "R[a b] R[a b] R[a b] R[a b] R[a b] R[a b] R[a b] R[a b] R[a] pause[b]"},
  {"has all its barriers again in the next activation",
   "ParallelAbsolute[barriers=.5](a b)", "a+.25 b+.5",
   "R[a b] R[a] pause[b] R[a b] resume[b] S[a] R[a b] R[a] pause[b] R[a b] resume[b] S[a]"},
  {"counts a child that succeeded as 1, whatever it reported last",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1S b=R.2R.6S", "R[a b] R[a b] S[b]"},
  {"reads progress also from a held child, and ticks it when it falls below the barrier",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1 b=R~0,.6,.6,.3", "R[a b] R[a] pause[b] R[a] R[a b] resume[b]"},
  {"begins the next child of a Sequence in the tick in which one completes, and holds it from the next tick on",
   "ParallelAbsolute[barriers=.5](Sequence[memory=true](a b) c)", "a=S b=R c=R.1", "R[a b c] R[c] pause[b]"},
  {"hold=between looks at the barrier before a Sequence begins its next child",
   "ParallelAbsolute[barriers=.5 hold=between](Sequence[memory=true](a b) c)", "a=S b=R c=R.1R.5",
   "R[a c] R[c] R[b c]"},
  {"hold=between: below the barrier a Sequence continues",
   "ParallelAbsolute[barriers=.75 hold=between](Sequence[memory=true](a b) c)", "a=S b=R c=R.1", "R[a b c]"},
  {"hold=between: a Sequence without memory is held behind its conditions",
   "ParallelAbsolute[barriers=.5 hold=between](Sequence(g? b) c)", "g=S b=R c=R.1R.5", "R[g c] R[c] R[g b c] R[g b c]"},
  {"hold=between: what counts is the progress of the whole child, deep in it",
   "ParallelAbsolute[barriers=.5 hold=between](Sequence[memory=true](a ForceSuccess(Parallel(Sequence[memory=true](b d) e))) c)",
   "a=RS b=S d=R e=R.5 c=R.1", "R[a c] R[a c] R[c]"},
  {"hold=between: in parallel branches, one that is behind continues",
   "ParallelAbsolute[barriers=.5 hold=between](Parallel(Sequence[memory=true](a b) d) c)", "a=S b=R d=R.1 c=R",
   "R[a b d c]"},
  {"hold=between asks within a tick how far a child is",
   "ParallelAbsolute[barriers=.5 hold=between](Parallel(a Sequence[memory=true](b d)) c)", "a=R<nan> b=S d=R c=R",
   "X{start a, tick a, start b, tick b, halt a}=a"},
  {"without hold=between, nobody asks within a tick",
   "ParallelAbsolute[barriers=.5](Parallel(a Sequence[memory=true](b d)) c)", "a=R<nan> b=S d=R c=R",
   "R[a b d c] X{halt a, halt d, halt c}=a"},
  {"hold=between: a Sequence of conditions is a guard",
   "ParallelAbsolute[barriers=.25 hold=between](Sequence[memory=true](Sequence(g? h?) b) c)", "g=S h=S b=R c=R.1",
   "R[g h c]"},
  {"takes one snapshot before any child is ticked",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.4R.6 b=R.5", "R[a b] R[a] pause[b] R[a b] resume[b]"},
  {"fails when a child fails, and halts the others",
   "ParallelAbsolute[barriers=.5](a b c)", "a=R b=RF c=R", "R[a b c] F[a b c] halt[a c]"},
  {"halts a held child without resuming it",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.1R.1F b=R.6", "R[a b] R[a] pause[b] F[a] halt[b]"},
  {"succeeds in the tick in which the last child succeeds",
   "ParallelAbsolute[barriers=.5](a b)", "a=S b=RS", "R[a b] S[b]"},
  {"does not tick again a child that succeeded",
   "ParallelAbsolute[barriers=1](a b)", "a=S b=RRS", "R[a b] R[b] S[b]"},
  {"asks a guard in every tick and never holds it",
   "ParallelAbsolute[barriers=.5](c? a b)", "c=SSSF a=R.1 b=R.6",
   "R[c a b] R[c a] pause[b] R[c a] F[c a] halt[a b]"},
  {"a guard that held counts as 1, so nobody waits for it",
   "ParallelAbsolute[barriers=.5](c? a b)", "c=S a=R.6 b=R.6", "R[c a b] R[c a b]"},
  {"the others wait for a guard that fails, where one failure is not the end",
   "ParallelAbsolute[barriers=.5 success_count=2 failure_count=2](c? a b)", "c=SFSS a=R.6 b=R.6",
   "R[c a b] R[c a b] R[c] pause[a b] R[c a b] resume[a b]"},
  {"memory=false starts a child again that has completed, and holds it at the barrier",
   "ParallelAbsolute[barriers=.5 memory=false](a b)", "a=SR.2 b=R.1R.1R.6",
   "R[a b] R[b] R[b] R{start a, tick a, tick b}"},
  {"succeeds when success_count have succeeded, and halts what runs or is held",
   "ParallelAbsolute[barriers=.5 success_count=1](a b c)", "a=R.1S b=R.2 c=R.7",
   "R[a b c] S[a b] pause[c] halt[b c]"},
  {"survives fewer failures than failure_count, and nobody waits for a child that failed",
   "ParallelAbsolute[barriers=.5 success_count=1 failure_count=2](a b c)", "a=R.1F b=R.4R.6 c=R.7",
   "R[a b c] R[a b] pause[c] R[b c] resume[c]"},
  {"fails as soon as success can no longer be reached",
   "ParallelAbsolute[barriers=.5 success_count=2 failure_count=3](a b c)", "a=F b=RF c=R",
   "R[a b c] F[b c] halt[c]"},
  {"judges success before failure",
   "ParallelAbsolute[barriers=.5 success_count=1](a b)", "a=F b=S", "S[a b]"},
  {"a child that failed for good is not in its progress",
   "ParallelAbsolute[barriers= success_count=1 failure_count=2](a b)", "a=F b=R.2", "R[a b]=.2"},
  {"has the progress of its least advanced child",
   "ParallelAbsolute[barriers=](a b c)", "a=R.4 b=R.2 c=S", "R[a b c]=.2"},
  {"ends the run when a child's progress is not a number, and ticks nobody after that",
   "ParallelAbsolute[barriers=.5](a b)", "a=R b=R<nan>", "R[a b] X{halt a, halt b}=b"},
};
// clang-format on

}  // namespace

TEST_CASE("ParallelAbsolute: worked traces") {
  check_traces(kTraces);
}

TEST_CASE("ParallelAbsolute") {
  check_rows(kParallelAbsoluteRows);
}

}  // namespace lockstep::host::test
