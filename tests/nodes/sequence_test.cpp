#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kSequenceRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"succeeds when all children succeed, in one tick if they do",
   "Sequence(a b)", "a=S b=S", "S[a b]"},
  {"stops at the first failure and returns it",
   "Sequence(a b)", "a=F b=S", "F[a]"},
  {"stops at the first running child and returns that",
   "Sequence(a b c)", "a=S b=R c=S", "R[a b]"},
  {"ticks from the first child in every tick",
   "Sequence(a b)", "a=S b=RRS", "R[a b] R[a b] S[a b]"},
  {"begins a new activation of a completed child that it ticks again",
   "Sequence(a b)", "a=S b=R", "R{start a, tick a, start b, tick b} R{start a, tick a, tick b}"},
  {"halts a running child when an earlier one fails",
   "Sequence(a? b)", "a=SF b=R", "R[a b] F[a] halt[b]"},
  {"halts a running child when an earlier one runs",
   "Sequence(a b)", "a=SR b=R", "R[a b] R[a] halt[b]"},
  {"halts all that runs under a child that it leaves, from the left",
   "Sequence(a? Parallel(b Sequence(c) d))", "a=SF b=R c=R d=R", "R[a b c d] F[a] halt[b c d]"},
  {"starts anew a child that it halted",
   "Sequence(a? b)", "a=SFS b=R", "R[a b] F[a] halt[b] R{start a, tick a, start b, tick b}"},
  {"tells a leaf its start once in an activation",
   "Sequence(a)", "a=RRS", "R{start a, tick a} R{tick a} S{tick a} S{start a, tick a}"},

  {"with memory does not tick a completed child again",
   "Sequence[memory=true](a b c)", "a=S b=RS c=RS", "R[a b] R[b c] S[c]"},
  {"with memory returns the failure of a later child",
   "Sequence[memory=true](a b)", "a=S b=RF", "R[a b] F[b]"},
  {"with memory forgets it on Success",
   "Sequence[memory=true](a b)", "a=S b=RS", "R[a b] S[b] S[a b]"},
  {"with memory forgets it on Failure",
   "Sequence[memory=true](a b)", "a=S b=RFR", "R[a b] F[b] R[a b]"},
  {"with memory forgets it when it is halted",
   "Sequence(c? Sequence[memory=true](a b))", "c=SFS a=S b=R", "R[c a b] F[c] halt[b] R[c a b]"},
  {"without memory is the default",
   "Sequence[memory=false](a b)", "a=S b=RS", "R[a b] S[a b]"},

  {"has the progress of its done children and the current one, divided by their number",
   "Sequence[memory=true](a b c d)", "a=S b=R.5S c=R.2 d=S", "R[a b]=.375 R[b c]=.55"},
  {"counts every child before the running one as done, also without memory",
   "Sequence(a b)", "a=S b=R.5", "R[a b]=.75"},
  {"falls back in progress when an earlier child runs again",
   "Sequence(a b)", "a=SR.1 b=R.5", "R[a b]=.75 R[a]=.05 halt[b]"},
  {"has progress 1 on Success and 0 on Failure",
   "Sequence(a)", "a=R.3SF", "R[a]=.3 S[a]=1 F[a]=0"},
};
// clang-format on

}  // namespace

TEST_CASE("Sequence") {
  check_rows(kSequenceRows);
}

}  // namespace lockstep::host::test
