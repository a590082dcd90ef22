#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kRepeatRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"succeeds after so many successes, one iteration a tick at most",
   "Repeat[times=3](a)", "a=S", "R[a] R[a] S[a]"},
  {"begins a new activation of its child for each iteration",
   "Repeat[times=2](a)", "a=RSS", "R{start a, tick a} R{tick a} S{start a, tick a}"},
  {"fails as soon as its child fails",
   "Repeat[times=3](a)", "a=SF", "R[a] F[a]"},
  {"without times goes on for ever",
   "Repeat(a)", "a=SSSSSF", "R[a] R[a] R[a] R[a] R[a] F[a]"},
  {"counts anew in a new activation",
   "Repeat[times=2](a)", "a=S", "R[a] S[a] R[a] S[a]"},
  {"counts anew after a failure",
   "Repeat[times=2](a)", "a=SFS", "R[a] F[a] R[a] S[a]"},
  {"counts anew after it was halted",
   "Sequence(c? Repeat[times=2](a))", "c=SFS a=S", "R[c a] F[c] R[c a] S[c a]"},
  {"has the progress of its done iterations and the current one, divided by times",
   "Repeat[times=4](a)", "a=R.4SR.4SSS", "R[a]=.1 R[a]=.25 R[a]=.35 R[a]=.5 R[a]=.75 S[a]=1"},
  {"without times has its child's progress",
   "Repeat(a)", "a=R.4", "R[a]=.4"},
};
// clang-format on

}  // namespace

TEST_CASE("Repeat") {
  check_rows(kRepeatRows);
}

}  // namespace lockstep::host::test
