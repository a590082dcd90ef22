#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kCooldownRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"Cooldown is skipped for a time after a Success",
   "Cooldown[seconds=.2](a)", "a=RSS", "R[a] S[a] K[] S[a]"},
  {"and after a Failure",
   "Cooldown[seconds=.2](a)", "a=FS", "F[a] K[] S[a]"},
  {"the time counts from the tick in which the child completed",
   "Cooldown[seconds=.3](a)", "a=RRRSS", "R[a] R[a] R[a] S[a] K[] K[] S[a]"},
  {"a child that was skipped is asked again at once",
   "Cooldown[seconds=.2](a)", "a=KS", "K[a] S[a] K[]"},
  {"so is one that was halted",
   "Sequence(c? Cooldown[seconds=1](a))", "c=SFS a=R", "R[c a] F[c] halt[a] R[c a]"},
  {"a new activation of what is around it does not end the time",
   "Sequence(c? Cooldown[seconds=.3](a) b)", "c=S a=SF b=S", "S[c a b] S[c b] S[c b] F[c a]"},
  {"0 is no time",
   "Cooldown[seconds=0](a)", "a=SF", "S[a] F[a]"},
  {"Cooldown has its child's progress",
   "Cooldown[seconds=.1](a)", "a=R.5S", "R[a]=.5 S[a]=1 S[a]"},
  {"the time goes on while what is around it is held: the node itself does not run",
   "ParallelAbsolute[barriers=.6](Sequence(Cooldown[seconds=.3](a) b) c)",
   "a=S b=R.1R.2 c=R.1R.2R.3R.4R.6S", "R[a b c] R[b c] R[c] pause[b] R[c] R[c] R[a b c] resume[b]"},
};
// clang-format on

}  // namespace

TEST_CASE("Cooldown") {
  check_rows(kCooldownRows);
}

}  // namespace lockstep::host::test
