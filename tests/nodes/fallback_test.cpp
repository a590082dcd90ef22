#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kFallbackRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"fails when all children fail",
   "Fallback(a b)", "a=F b=F", "F[a b]"},
  {"stops at the first success and returns it",
   "Fallback(a b)", "a=S b=F", "S[a]"},
  {"stops at the first running child and returns that",
   "Fallback(a b c)", "a=F b=R c=S", "R[a b]"},
  {"ticks from the first child in every tick",
   "Fallback(a b)", "a=F b=RRS", "R[a b] R[a b] S[a b]"},
  {"halts a child that it leaves on a success",
   "Fallback(a b)", "a=FS b=R", "R[a b] S[a] halt[b]"},
  {"halts a child that it leaves for a running one",
   "Fallback(a b)", "a=FR b=R", "R[a b] R[a] halt[b]"},

  {"with memory does not tick a failed child again",
   "Fallback[memory=true](a b c)", "a=F b=RF c=RS", "R[a b] R[b c] S[c]"},
  {"with memory forgets it on Success",
   "Fallback[memory=true](a b)", "a=F b=RS", "R[a b] S[b] S[a b]"},
  {"with memory forgets it on Failure",
   "Fallback[memory=true](a b)", "a=F b=RFR", "R[a b] F[b] R[a b]"},
  {"with memory forgets it when it is halted",
   "Sequence(c? Fallback[memory=true](a b))", "c=SFS a=F b=R", "R[c a b] F[c] halt[b] R[c a b]"},

  {"has the progress of the child that is active",
   "Fallback(a b c)", "a=F b=R.25F c=R.5", "R[a b]=.25 R[a b c]=.5"},
  {"has progress 1 on Success and 0 on Failure",
   "Fallback(a)", "a=R.3SF", "R[a]=.3 S[a]=1 F[a]=0"},
};
// clang-format on

}  // namespace

TEST_CASE("Fallback") {
  check_rows(kFallbackRows);
}

}  // namespace lockstep::host::test
