#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kDelayRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"runs until the time is over and ticks its child in that tick",
   "Delay[seconds=.2](a)", "a=RS", "R[] R[] R[a] S[a]"},
  {"of no time ticks its child at once",
   "Delay[seconds=0](a)", "a=F", "F[a]"},
  {"waits again in a new activation",
   "Delay[seconds=.1](a)", "a=S", "R[] S[a] R[] S[a]"},
  {"waits again after it was halted, and its child was never told",
   "Sequence(c? Delay[seconds=.1](a))", "c=SFS a=S", "R[c] F[c] R[c] S[c a]"},
  {"stands still while it is held",
   "ParallelAbsolute[barriers=.5](a Sequence[memory=true](b Delay[seconds=.3](c)))",
   "a=R~.1,.1,.1,.1,.6 b=S c=R", "R[a b] R[a] R[a] R[a] R[a] R[a] R[a c]"},
  {"with clock=wall goes on while it is held",
   "ParallelAbsolute[barriers=.5](a Sequence[memory=true](b Delay[seconds=.3 clock=wall](c)))",
   "a=R~.1,.1,.1,.1,.6 b=S c=R", "R[a b] R[a] R[a] R[a] R[a c]"},
  {"has progress 0 while it waits, then its child's",
   "Delay[seconds=.1](a)", "a=R.3", "R[]=0 R[a]=.3"},
};
// clang-format on

}  // namespace

TEST_CASE("Delay") {
  check_rows(kDelayRows);
}

}  // namespace lockstep::host::test
