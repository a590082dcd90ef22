#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kKeepRunningUntilFailureRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"runs while its child runs or succeeds, and fails when it fails",
   "KeepRunningUntilFailure(a)", "a=RSSF", "R[a] R[a] R[a] F[a]"},
  {"begins a new activation of a child that succeeded",
   "KeepRunningUntilFailure(a)", "a=RSR", "R{start a, tick a} R{tick a} R{start a, tick a}"},
  {"has its child's progress",
   "KeepRunningUntilFailure(a)", "a=R.3", "R[a]=.3"},
};
// clang-format on

}  // namespace

TEST_CASE("KeepRunningUntilFailure") {
  check_rows(kKeepRunningUntilFailureRows);
}

}  // namespace lockstep::host::test
