#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kWaitRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"runs for its time and succeeds in the tick at which it is over",
   "Wait[seconds=.2]", "", "R[] R[] S[]"},
  {"succeeds at the first tick after its time",
   "Wait[seconds=.25]", "", "R[] R[] R[] S[]"},
  {"of no time succeeds at once",
   "Wait[seconds=0]", "", "S[]"},
  {"waits again in a new activation",
   "Wait[seconds=.1]", "", "R[] S[] R[] S[]"},
  {"waits again after it was halted",
   "Sequence(c? Wait[seconds=.2])", "c=SSFS", "R[c] R[c] F[c] R[c] R[c] S[c]"},
  {"has the progress elapsed / duration",
   "Wait[seconds=.4]", "", "R[]=0 R[]=.25 R[]=.5 R[]=.75 S[]=1"},
  {"stands still while it is paused",
   "ParallelAbsolute[barriers=.5](a Wait[seconds=.4])", "a=R~.1,.1,.1,.1,.1,.9,.9,1",
   "R[a]=0 R[a]=.1 R[a]=.1 R[a]=.1 R[a]=.1 R[a]=.5 R[a]=.75 R[a]=1"},
};
// clang-format on

}  // namespace

TEST_CASE("Wait") {
  check_rows(kWaitRows);
}

}  // namespace lockstep::host::test
