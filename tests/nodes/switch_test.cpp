#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kSwitchRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"Switch ticks the child of the case that equals the value",
   "Sequence[memory=true](Script[code=n:=2] Switch[on=n cases=1;2;3](a b c))", "a=S b=F c=S", "F[b]"},
  {"the cases of a text",
   "Sequence[memory=true](Script[code=m:='dock'] Switch[on=m cases=drive;dock](a b))", "a=F b=S", "S[b]"},
  {"of a yes or no",
   "Sequence[memory=true](Script[code=m:=false] Switch[on=m cases=true;false](a b))", "a=F b=S", "S[b]"},
  {"of a calculation",
   "Switch[on=7/2 cases=3;3.5](a b)", "a=F b=S", "S[b]"},
  {"one child more is for all other values",
   "Sequence[memory=true](Script[code=n:=9] Switch[on=n cases=1;2](a b c))", "a=F b=F c=S", "S[c]"},
  {"Switch fails when no case fits and there is no such child",
   "Sequence[memory=true](Script[code=n:=9] Switch[on=n cases=1;2](a b))", "a=S b=S", "F[]"},
  {"it asks in every tick, and halts the child that it leaves",
   "Parallel(Script[code=n:=1] Switch[on=n cases=1;2](a b) c[on_success=n:=2])", "a=R b=RS c=RS",
   "R[a c] R[a c] R[b] halt[a] S[b]"},
  {"when nothing fits any more, the child that runs is halted",
   "Parallel(Script[code=n:=1] Switch[on=n cases=1](a) c[on_success=n:=2])", "a=R c=S",
   "R[a c] F[] halt[a]"},
  {"Switch is skipped when its child is",
   "Switch[on=1 cases=1](a)", "a=K", "K[a]"},
  {"Switch has the progress of its child",
   "Switch[on=1 cases=1;2](a b)", "a=R.5 b=S", "R[a]=.5"},
  {"no value is a fault",
   "Sequence(Fallback(Switch[on=n cases=1](a) Script[code=n:=1]))", "a=S", "X[]=Switch"},
};
// clang-format on

}  // namespace

TEST_CASE("Switch") {
  check_rows(kSwitchRows);
}

}  // namespace lockstep::host::test
