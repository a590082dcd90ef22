#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kParallelRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"ticks all children in one tick, from the left",
   "Parallel(a b c)", "a=R b=R c=R", "R[a b c]"},
  {"succeeds when all have succeeded",
   "Parallel(a b)", "a=RS b=S", "R[a b] S[a]"},
  {"does not tick again a child that completed in this activation",
   "Parallel[failure_count=3](a b c)", "a=S b=F c=RRS", "F[a b c] halt[c]"},
  {"keeps the result of a completed child",
   "Parallel[success_count=1 failure_count=2](a b c)", "a=F b=RRF c=R", "R[a b c] R[b c] F[b c] halt[c]"},
  {"fails with the first failure and halts what still runs",
   "Parallel(a b c)", "a=R b=RF c=R", "R[a b c] F[a b c] halt[a c]"},
  {"ticks all children also in the tick in which it fails",
   "Parallel(a b)", "a=F b=R", "F[a b] halt[b]"},
  {"succeeds when success_count have succeeded and halts what still runs",
   "Parallel[success_count=2](a b c)", "a=S b=RS c=R", "R[a b c] S[b c] halt[c]"},
  {"survives fewer failures than failure_count",
   "Parallel[success_count=1 failure_count=2](a b c)", "a=F b=F c=S", "S[a b c]"},
  {"fails as soon as success can no longer be reached",
   "Parallel[success_count=2 failure_count=3](a b c)", "a=F b=RF c=R", "R[a b c] F[b c] halt[c]"},
  {"judges success before failure when both are reached in a tick",
   "Parallel[success_count=1 failure_count=1](a b)", "a=F b=S", "S[a b]"},
  {"begins anew after it has completed",
   "Parallel(a b)", "a=S b=RSR", "R[a b] S[b] R[a b]"},
  {"forgets the results of its children when it is halted",
   "Sequence(c? Parallel(a b))", "c=SFS a=S b=R", "R[c a b] F[c] halt[b] R[c a b]"},

  {"asks a condition in every tick, also after it has succeeded",
   "Parallel(c? a)", "c=SSF a=R", "R[c a] R[c a] F[c a] halt[a]"},
  {"a guard that holds to the end counts as succeeded",
   "Parallel(c? a)", "c=S a=RRS", "R[c a] R[c a] S[c a]"},
  {"asks a guard again that has failed, where one failure is not the end",
   "Parallel[success_count=2 failure_count=2](c? a b)", "c=SFSS a=RRRS b=R",
   "R[c a b] R[c a b] R[c a b] S[c a b] halt[b]"},
  {"asks conditions also under decorators and control nodes",
   "Parallel(Inverter(Fallback(c? Sequence(d? e?))) SubTree(f?) a)", "c=F d=S e=FFS f=S a=R",
   "R[c d e f a] R[c d e f a] F[c d e f a] halt[a]"},
  {"latches a child as soon as an action is in it",
   "Parallel(Sequence(c? b) a)", "c=SF b=S a=RRS", "R[c b a] R[a] S[a]"},
  {"a guard that runs is one too",
   "Parallel(KeepRunningUntilFailure(c?) a)", "c=SSF a=R", "R[c a] R[c a] F[c a] halt[a]"},
  {"memory=false starts a child again that has completed",
   "Parallel[memory=false](a b)", "a=SRS b=RRS",
   "R{start a, tick a, start b, tick b} R{start a, tick a, tick b} S{tick a, tick b}"},
  {"memory=false judges by the last results",
   "Parallel[memory=false failure_count=2 success_count=1](a b)", "a=FFR b=RFR",
   "R[a b] F[a b]"},

  {"has the progress of the least advanced child by default",
   "Parallel(a b c)", "a=R.5 b=R.2 c=S", "R[a b c]=.2"},
  {"has the progress of the M-th most advanced child when M must succeed",
   "Parallel[success_count=2](a b c)", "a=R.5 b=R.2 c=R.9", "R[a b c]=.5"},
  {"counts a child that succeeded as 1 and one that failed as 0",
   "Parallel[success_count=2 failure_count=2](a b c d)", "a=S b=F c=R.4 d=R.3", "R[a b c d]=.4"},
};
// clang-format on

}  // namespace

TEST_CASE("Parallel") {
  check_rows(kParallelRows);
}

}  // namespace lockstep::host::test
