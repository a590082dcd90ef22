#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kRunOnceRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"returns its child's success again without ticking it",
   "RunOnce(a)", "a=RSF", "R[a] S[a] S[] S[]"},
  {"returns its child's failure again without ticking it",
   "RunOnce(a)", "a=FS", "F[a] F[]"},
  {"survives new activations of its parents",
   "Sequence(RunOnce(a) b)", "a=S b=SRS", "S[a b] R[b] S[b]"},
  {"survives a halt of its parents",
   "Sequence(c? RunOnce(a) b)", "c=SFS a=S b=R", "R[c a b] F[c] halt[b] R[c b]"},
  {"begins its child anew when it was halted before it completed",
   "Sequence(c? RunOnce(a))", "c=SFS a=RS", "R[c a] F[c] halt[a] S[c a] S[c]"},
  {"has its child's progress",
   "RunOnce(a)", "a=R.3S", "R[a]=.3 S[a]=1 S[]=1"},
};
// clang-format on

}  // namespace

TEST_CASE("RunOnce") {
  check_rows(kRunOnceRows);
}

}  // namespace lockstep::host::test
