#include <catch2/catch.hpp>

#include "support/scripted_run.h"
#include "support/synchronized_trace.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr SynchronizedTrace kRelativeTraces[] = {
  {"R1", "ParallelRelative[delta=.2](a b)", "a+.1 b+.3",
   "12 12 1- 1- 12 1- 1- 12 1. 1.", 2.30},
  {"R2", "ParallelRelative[delta=0](a b)", "a+.2 b+.3",
   "12 1- -2 1- 12 1- .2", 0.60, "0,0 .2,.3 .4,.3 .4,.6 .6,.6 .8,.9 1,.9"},
  {"R3", "ParallelRelative[delta=.1](a b c)", "a+.05 b+.1 c+.25",
   "123 12- 12- 1-3 12- 1-- 12- 1-- 123 1-- 12- 1-- 12- 1-3 12. 1-. 12. 1.. 1.. 1..", 7.20},
  {"R4", "ParallelRelative[delta=1](a b)", "a+.25 b+.5",
   "12 12 1. 1.", 1.00},
};

constexpr TickRow kParallelRelativeRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"hold=between looks at delta before a Sequence begins its next child",
   "ParallelRelative[delta=.25 hold=between](Sequence[memory=true](a b) c)", "a=S b=R c=R.1R.3",
   "R[a c] R[c] R[b c]"},
  {"R5: keeps perpetual actions in step, in every corner of their progress",
   "ParallelRelative[delta=.5](a b)", "a=R~0,0,1,1 b=R~0,1,0,1",
   "R[a b] R[a] pause[b] R[b] pause[a] resume[b] R[a b] resume[a]"},
  {"holds a child that is more than delta ahead of the slowest",
   "ParallelRelative[delta=.2](a b)", "a=R.1 b=R.31", "R[a b] R[a] pause[b]"},
  {"ticks a child that is exactly delta ahead, also where doubles say that it is more",
   "ParallelRelative[delta=.1](a b)", "a=R.7 b=R.8", "R[a b] R[a b]"},
  {"with delta 0 is strict lockstep",
   "ParallelRelative[delta=0](a b)", "a=R.1R.2 b=R.2", "R[a b] R[a] pause[b] R[a b] resume[b]"},
  {"with delta 1 waits for nobody",
   "ParallelRelative[delta=1](a b)", "a=R0 b=R1", "R[a b] R[a b]"},
  {"compares with the slowest of all children",
   "ParallelRelative[delta=.2](a b c)", "a=R.5 b=R.3 c=R.1", "R[a b c] R[b c] pause[a]"},
  {"clamps progress outside of [0, 1]",
   "ParallelRelative[delta=1](a b)", "a=R-3 b=R7", "R[a b]=0 R[a b]=0"},
  {"counts a child that succeeded as 1, whatever it reported last",
   "ParallelRelative[delta=.1](a b)", "a=R.1S b=R.2R.6S", "R[a b] R[a b] S[b]"},
  {"an action without progress has 0 until it succeeds",
   "ParallelRelative[delta=.1](a[bare] b)", "a=RRSR b=R.5R.6", "R[a b] R[a] pause[b] R[a] R[b] resume[b]"},
  {"fails when a child fails, and halts the others",
   "ParallelRelative[delta=1](a b c)", "a=R b=RF c=R", "R[a b c] F[a b c] halt[a c]"},
  {"halts a held child without resuming it",
   "ParallelRelative[delta=.1](a b)", "a=R.1R.1F b=R.6", "R[a b] R[a] pause[b] F[a] halt[b]"},
  {"asks a guard in every tick and never holds it",
   "ParallelRelative[delta=.1](c? a b)", "c=SSSF a=R.1 b=R.6",
   "R[c a b] R[c a] pause[b] R[c a] F[c a] halt[a b]"},
  {"the others wait for a guard that fails, where one failure is not the end",
   "ParallelRelative[delta=.1 success_count=2 failure_count=2](c? a b)", "c=SFSS a=R.6 b=R.6",
   "R[c a b] R[c a b] R[c] pause[a b] R[c a b] resume[a b]"},
  {"memory=false starts a child again that has completed, once the others are within delta",
   "ParallelRelative[delta=.5 memory=false](a b)", "a=SR.2 b=R.1R.6",
   "R[a b] R[b] R{start a, tick a, tick b}"},
  {"a perpetual child need not succeed where one success is enough",
   "ParallelRelative[delta=0 success_count=1](a b)", "a=R~1,0,1 b+.5",
   "R[a b] R[a] pause[b] S[b] pause[a] resume[b] halt[a]"},
  {"survives fewer failures than failure_count, and nobody waits for a child that failed",
   "ParallelRelative[delta=0 success_count=1 failure_count=2](a b)", "a=R.1F b=R.7",
   "R[a b] R[a] pause[b] R[b] resume[b]"},
  {"has the progress of its least advanced child",
   "ParallelRelative[delta=1](a b c)", "a=R.4 b=R.2 c=S", "R[a b c]=.2"},
  {"ends the run when a child's progress is not a number, and ticks nobody after that",
   "ParallelRelative[delta=.5](a b)", "a=R<nan> b=R", "R[a b] X{halt a, halt b}=a"},
};
// clang-format on

// Two actions that lose while they are held what they gain: the ticks to Success; 0: never.
int ticks_to_end(const std::string& delta) {
  ScriptedRun run("ParallelRelative[delta=" + delta + "](a b)", "a+.3/.3 b+.2/.3");
  for (int tick = 1; tick <= 1000; ++tick) {
    if (run.tick(tick * std::chrono::milliseconds(100)) == Status::Success) return tick;
  }
  return 0;
}

}  // namespace

TEST_CASE("ParallelRelative: worked traces") {
  check_traces(kRelativeTraces);
}

TEST_CASE("ParallelRelative: progress that falls while it is held can keep it from ending") {
  CHECK(ticks_to_end("1") == 5);
  CHECK(ticks_to_end("0.1") == 10);
  CHECK(ticks_to_end("0") == 0);
}

TEST_CASE("ParallelRelative") {
  check_rows(kParallelRelativeRows);
}

}  // namespace lockstep::host::test
