#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kRetryRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"fails when the last attempt fails, one attempt a tick at most",
   "Retry[attempts=3](a)", "a=F", "R[a] R[a] F[a]"},
  {"begins a new activation of its child for each attempt",
   "Retry[attempts=2](a)", "a=RFS", "R{start a, tick a} R{tick a} S{start a, tick a}"},
  {"succeeds as soon as its child succeeds",
   "Retry[attempts=3](a)", "a=FS", "R[a] S[a]"},
  {"counts anew in a new activation",
   "Retry[attempts=2](a)", "a=F", "R[a] F[a] R[a] F[a]"},
  {"counts anew after a success",
   "Retry[attempts=2](a)", "a=FSF", "R[a] S[a] R[a] F[a]"},
  {"counts anew after it was halted",
   "Sequence(c? Retry[attempts=2](a))", "c=SFS a=F", "R[c a] F[c] R[c a] F[c a]"},
  {"has the progress of the current attempt",
   "Retry[attempts=4](a)", "a=R.4FR.3", "R[a]=.4 R[a]=0 R[a]=.3"},
};
// clang-format on

}  // namespace

TEST_CASE("Retry") {
  check_rows(kRetryRows);
}

}  // namespace lockstep::host::test
