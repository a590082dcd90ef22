#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kBranchesRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"IfThenElse ticks its second child when the first succeeds",
   "IfThenElse(c? a b)", "c=S a=F b=S", "F[c a]"},
  {"IfThenElse ticks its third child when the first fails",
   "IfThenElse(c? a b)", "c=F a=F b=S", "S[c b]"},
  {"IfThenElse asks once in an activation",
   "IfThenElse(c? a b)", "c=SF a=RS b=RS", "R[c a] S[a] R[c b] S[b]"},
  {"IfThenElse: a condition may take time",
   "IfThenElse(c a b)", "c=RS a=S b=S", "R[c] S[c a]"},
  {"IfThenElse fails when its condition does and there is no third child",
   "IfThenElse(c? a)", "c=FS a=S", "F[c] S[c a]"},
  {"IfThenElse has the progress of its branch, and 0 before",
   "IfThenElse(c a b)", "c=R.5S a=R.25 b=S", "R[c]=0 R[c a]=.25"},
  {"IfThenElse halts what runs in it",
   "Sequence(c? IfThenElse(d? a b))", "c=SF d=S a=R b=S", "R[c d a] F[c] halt[a]"},
  {"WhileDoElse asks in every tick, and halts the branch that it leaves",
   "WhileDoElse(c? a b)", "c=SSFS a=RRS b=R", "R[c a] R[c a] R[c b] halt[a] S[c a] halt[b]"},
  {"WhileDoElse: a condition that completed is started again, an action too",
   "WhileDoElse(c a b)", "c=SS a=RS b=S", "R{start c, tick c, start a, tick a} S{start c, tick c, tick a}"},
  {"WhileDoElse: while its condition runs, no branch does",
   "WhileDoElse(c a b)", "c=SRS a=RR b=S", "R[c a] R[c] halt[a] R[c a]"},
  {"WhileDoElse fails when its condition does and there is no third child",
   "WhileDoElse(c? a)", "c=SF a=R", "R[c a] F[c] halt[a]"},
  {"WhileDoElse has the progress of its branch",
   "WhileDoElse(c? a b)", "c=SF a=R.5 b=R.25", "R[c a]=.5 R[c b]=.25 halt[a]"},
};
// clang-format on

}  // namespace

TEST_CASE("IfThenElse and WhileDoElse") {
  check_rows(kBranchesRows);
}

}  // namespace lockstep::host::test
