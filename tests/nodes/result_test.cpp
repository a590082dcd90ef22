#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kResultRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"Inverter turns Success into Failure", "Inverter(a)", "a=RS", "R[a] F[a]"},
  {"Inverter turns Failure into Success", "Inverter(a)", "a=RF", "R[a] S[a]"},
  {"Inverter has its child's progress", "Inverter(a)", "a=R.3F", "R[a]=.3 S[a]=1"},
  {"ForceSuccess succeeds with Success", "ForceSuccess(a)", "a=RS", "R[a] S[a]"},
  {"ForceSuccess succeeds with Failure", "ForceSuccess(a)", "a=RF", "R[a] S[a]"},
  {"ForceSuccess has its child's progress", "ForceSuccess(a)", "a=R.3F", "R[a]=.3 S[a]=1"},
  {"ForceFailure fails with Success", "ForceFailure(a)", "a=RS", "R[a] F[a]"},
  {"ForceFailure fails with Failure", "ForceFailure(a)", "a=RF", "R[a] F[a]"},
  {"ForceFailure has its child's progress", "ForceFailure(a)", "a=R.3S", "R[a]=.3 F[a]=0"},
  {"SubTree returns what its tree returns", "SubTree(a)", "a=RSF", "R[a] S[a] F[a]"},
  {"SubTree has the progress of its tree", "SubTree(a)", "a=R.3", "R[a]=.3"},
  {"a halt reaches through decorators",
   "Sequence(c? Inverter(ForceSuccess(ForceFailure(SubTree(a)))))", "c=SF a=R", "R[c a] F[c] halt[a]"},
};
// clang-format on

}  // namespace

TEST_CASE("Inverter, ForceSuccess, ForceFailure, SubTree") {
  check_rows(kResultRows);
}

}  // namespace lockstep::host::test
