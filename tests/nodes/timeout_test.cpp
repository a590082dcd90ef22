#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kTimeoutRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"returns what its child returns in time",
   "Timeout[seconds=.25](a)", "a=RS", "R[a] S[a]"},
  {"halts its child and fails in the tick at which the time is over, without ticking it",
   "Timeout[seconds=.2](a)", "a=R", "R[a] R[a] F[] halt[a]"},
  {"fails at the first tick after the time",
   "Timeout[seconds=.25](a)", "a=R", "R[a] R[a] R[a] F[] halt[a]"},
  {"counts from the first tick of each activation",
   "Timeout[seconds=.2](a)", "a=RRRS", "R[a] R[a] F[] halt[a] R[a] S[a]"},
  {"counts anew after it was halted",
   "Sequence(c? Timeout[seconds=.2](a))", "c=SFS a=R", "R[c a] F[c] halt[a] R[c a] R[c a] F[c] halt[a]"},
  {"stands still while it is held",
   "ParallelRelative[delta=0](a Timeout[seconds=.3](b))", "a=R~0,0,0,0,.5,.5 b=R.5",
   "R[a b] R[a] pause[b] R[a] R[a] R[a b] resume[b] R[a b] F[a] halt[b a]"},
  {"counts what was between its last tick and the one that was withheld",
   "ParallelRelative[delta=0](a Timeout[seconds=.1](b))", "a=R~0,0,.5 b=R.5",
   "R[a b] R[a] pause[b] F[a] halt[b a]"},
  {"stands still in each of two pauses",
   "ParallelRelative[delta=0](a Timeout[seconds=.4](b))", "a=R~0,0,.5,0,0,.5,.5 b=R.5",
   "R[a b] R[a] pause[b] R[a b] resume[b] R[a] pause[b] R[a] R[a b] resume[b] R[a b] F[a] halt[b a]"},
  {"with clock=wall goes on while it is held, and acts in its next tick",
   "ParallelRelative[delta=0](a Timeout[seconds=.2 clock=wall](b))", "a=R~0,0,0,0,.5 b=R.5",
   "R[a b] R[a] pause[b] R[a] R[a] F[a] halt[b a]"},
  {"is not held when it stands around the node that holds",
   "Timeout[seconds=.2](ParallelRelative[delta=0](a b))", "a=R~0 b=R.5",
   "R[a b] R[a] pause[b] F[] halt[a b]"},
  {"has its child's progress",
   "Timeout[seconds=5](a)", "a=R.3", "R[a]=.3"},
};
// clang-format on

}  // namespace

TEST_CASE("Timeout") {
  check_rows(kTimeoutRows);
}

}  // namespace lockstep::host::test
