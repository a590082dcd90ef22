#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kRateRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"Rate starts its child at most once in the time, and returns the last result in between",
   "Rate[seconds=.2](a)", "a=SFS", "S[a] S[] F[a] F[] S[a]"},
  {"a child that runs is ticked in every tick",
   "Rate[seconds=.2](a)", "a=RRRSS", "R[a] R[a] R[a] S[a] S[a] S[]"},
  {"the time counts from the start of the child",
   "Rate[seconds=.3](a)", "a=RSF", "R[a] S[a] S[] F[a]"},
  {"behind it, others go on with the last result",
   "Sequence(Rate[seconds=.2](a) b)", "a=SSF b=R", "R[a b] R[b] R[a b] R[b] F[a] halt[b]"},
  {"a condition is asked so often, too",
   "Sequence(Rate[seconds=.2](c?) a)", "c=SFS a=R", "R[c a] R[a] F[c] halt[a] F[] R[c a]"},
  {"a child that was skipped is asked again at once",
   "Rate[seconds=.2](a)", "a=KSF", "K[a] S[a] S[] F[a]"},
  {"one that was halted is started again at once",
   "Sequence(c? Rate[seconds=1](a))", "c=SFS a=R", "R[c a] F[c] halt[a] R[c a]"},
  {"0 is no time",
   "Rate[seconds=0](a)", "a=SF", "S[a] F[a]"},
  {"Rate has its child's progress, and that of its last result",
   "Rate[seconds=.3](a)", "a=R.5S", "R[a]=.5 S[a]=1 S[]=1"},
  {"time in which it is held does not count",
   "ParallelAbsolute[barriers=.5 success_count=1 memory=false](Rate[seconds=.4](a) b)",
   "a=R.6S b=R.1R.2R.3R.5R.6R.7R.8R.9",
   "R[a b] R[b] pause[a] R[b] R[b] S[a b] resume[a] halt[b]"},
};
// clang-format on

}  // namespace

TEST_CASE("Rate") {
  check_rows(kRateRows);
}

}  // namespace lockstep::host::test
