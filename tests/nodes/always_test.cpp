#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kAlwaysRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"AlwaysSuccess succeeds", "AlwaysSuccess", "", "S[]=1 S[]=1"},
  {"AlwaysFailure fails", "AlwaysFailure", "", "F[]=0 F[]=0"},
  {"AlwaysRunning runs, with progress 0", "AlwaysRunning", "", "R[]=0 R[]=0"},
};
// clang-format on

}  // namespace

TEST_CASE("AlwaysSuccess, AlwaysFailure, AlwaysRunning") {
  check_rows(kAlwaysRows);
}

}  // namespace lockstep::host::test
