// Script and Check, and the scripts around the ticks of a node.
#include <catch2/catch.hpp>

#include "support/scripted_run.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kLeaves[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"Script runs and succeeds at once",
   "Sequence[memory=true](Script[code=n:=2] Check[code=n==2] a)", "a=S", "S[a]"},
  {"Check is a Success when its script is true, else a Failure",
   "Sequence[memory=true](Script[code=n:=2] Fallback(Check[code=n>2] a))", "a=S", "S[a]"},
  {"Check is asked in every tick where its parent asks it: a guard",
   "Parallel(Script[code=n:=0] Check[code=n<2] a[on_success=n+=1] b[on_success=n:=2] c)",
   "a=S b=RS c=R", "R[a b c] R[b c] F[c] halt[c]"},
  {"Script that completed in a parallel is not run again",
   "Sequence[memory=true](Script[code=n:=0] Parallel(Script[code=n+=1] a) Check[code=n==1] b)",
   "a=RRS b=S", "R[a] R[a] S[a b]"},
  {"a script that cannot go on is a fault of its node",
   "Sequence(Script[code=n:=0;n:='a']  a)", "a=S", "X[]=Script"},
  {"so is a Check whose value is no yes and no no",
   "Sequence(Script[code=n:=2] Check[code=n])", "", "X[]=Check"},
  {"an entry that has no value cannot be computed with",
   "Sequence(Fallback(Check[code=n>1] Script[code=n:=1]))", "", "X[]=Check"},
};

constexpr TickRow kHooks[] = {
  {"failure_if is asked first: a Failure without a tick",
   "Sequence[memory=true](Script[code=n:=1] a[failure_if=n==1 success_if=true])", "a=S", "F[]"},
  {"success_if is asked before skip_if: a Success without a tick",
   "Sequence[memory=true](Script[code=n:=1] a[success_if=n==1 skip_if=true])", "a=F", "S[]"},
  {"skip_if: as if the node were not there",
   "Sequence[memory=true](Script[code=n:=1] a[skip_if=n==1] b)", "a=F b=S", "S[b]"},
  {"they are asked when an activation begins only",
   "Parallel(Script[code=n:=0] a[skip_if=n>0 failure_if=n>0 success_if=n>0] b[on_success=n:=1])",
   "a=RRS b=S", "R[a b] R[a] S[a]"},
  {"while is asked before every tick; false halts the node and skips it",
   "Sequence[memory=true](Script[code=n:=0] Parallel(a[while=n<1] b[on_success=n:=1] c))",
   "a=RR b=RS c=RRS", "R[a b c] R[a b c] S[c] halt[a]"},
  {"so it is between leaves that have none",
   "Sequence[memory=true](Script[code=n:=0] Parallel(c a[while=n<1] b[on_success=n:=1]))",
   "c=RRS a=RR b=RS", "R[c a b] R[c a b] S[c] halt[a]"},
  {"a fault of the halt that while asks for: the leaf is halted once",
   "Sequence[memory=true](Script[code=n:=0] Parallel(a[while=n<1] b[on_success=n:=1] c))",
   "a=R!halt b=S c=R", "R[a b c] X{halt a, halt c}=a"},
  {"while that is false from the start skips the node",
   "Sequence[memory=true](Script[code=n:=1] a[while=n<1] b)", "a=R b=S", "S[b]"},
  {"on_success runs after a Success, on_failure after a Failure, on_end after both",
   "Sequence[memory=true](Script[code=n:=0] a[on_success=n+=1 on_failure=n+=10 on_end=n*=2] "
   "ForceSuccess(b[on_success=n+=1 on_failure=n+=10 on_end=n*=2]) Check[code=n==24] c)",
   "a=S b=F c=S", "S[a b c]"},
  {"they run also when a script gave the result",
   "Sequence[memory=true](Script[code=n:=0] a[success_if=true on_success=n+=1] Check[code=n==1] b)",
   "a=F b=S", "S[b]"},
  {"none of them runs after a skip",
   "Sequence[memory=true](Script[code=n:=0] a[skip_if=true on_success=n:=1 on_failure=n:=1 on_end=n:=1 "
   "on_halt=n:=1] Check[code=n==0] b)", "a=S b=S", "S[b]"},
  {"those of a child run before those of its parent",
   "Sequence[memory=true](Script[code=n:=0] Inverter[on_failure=n*=2](a[on_success=n+=1]) )",
   "a=S", "F[a]"},
  {"on_halt runs when the node was halted",
   "Sequence[memory=true](Script[code=n:=0] Parallel[success_count=1](a[on_halt=n:=1] b) Check[code=n==1] c)",
   "a=R b=RS c=S", "R[a b] S[a b c] halt[a]"},
  {"on_halt of children runs before that of their parent, from the left",
   "Sequence[memory=true](Script[code=n:=1] Parallel[success_count=1](Parallel[on_halt=n*=3](a[on_halt=n+=1] "
   "b[on_halt=n*=2]) c) Check[code=n==12] d)", "a=R b=R c=S d=S", "S[a b c d] halt[a b]"},
  {"scripts of a SubTree run around its tree",
   "Sequence[memory=true](Script[code=n:=0] SubTree[on_success=n+=1](a) SubTree[skip_if=n==1](b) c)",
   "a=RS b=F c=S", "R[a] S[a c]"},
  {"an activation that begins again asks again",
   "Sequence(Script[code=n:=0] Fallback(Check[code=n>=2] AlwaysSuccess) "
   "Repeat[times=2](a[skip_if=n>0]))", "a=SS", "R[a] S[a]"},
  {"a script that fails is a fault of the node that has it",
   "Sequence[memory=true](Script[code=n:=0] a[skip_if=n/0])", "a=R", "S[]"},
  {"a condition that is neither yes nor no is a fault of the node that has it",
   "Sequence[memory=true](Script[code=n:=2] a[skip_if=n])", "a=R", "X[]=a"},
};

constexpr TickRow kHeld[] = {
  {"while of a held child is not asked; when ticks come again, it is",
   "Sequence[memory=true](Script[code=n:=0] ParallelAbsolute[barriers=.5](a[while=n<1] b[on_success=n:=1]))",
   "a=R.5R.6S b=R.1R.2R.3S",
   "R[a b] R[b] pause[a] R[b] R[b] S[] halt[a]"},
};
// clang-format on

}  // namespace

TEST_CASE("Script and Check") {
  check_rows(kLeaves);
}

TEST_CASE("scripts around the ticks of a node") {
  check_rows(kHooks);
}

TEST_CASE("scripts of held nodes") {
  check_rows(kHeld);
}

TEST_CASE("the entries of scripts have types, by ports, by ':=', and from each other") {
  ScriptedRun run(
      "Sequence[memory=true](Script[code=whole:=0;real:=whole+1;word:='a'..whole;flag:=whole==0;"
      "either:=flag?1:2.5;copy:=real;yes:=true] Wait[seconds={pause}] Script[code=pause:=0])",
      "");
  const std::pair<std::string_view, ValueType> expected[] = {
      {"whole", ValueType::Int}, {"real", ValueType::Double},   {"word", ValueType::String},
      {"flag", ValueType::Bool}, {"either", ValueType::Double}, {"copy", ValueType::Double},
      {"yes", ValueType::Bool},  {"pause", ValueType::Double}};
  CHECK(run.tree().slots.size() == std::size(expected));
  for (const Slot& slot : run.tree().slots) {
    INFO(slot.name);
    const auto it = std::ranges::find(expected, slot.name, [](auto& each) { return each.first; });
    REQUIRE(it != std::end(expected));
    CHECK(slot.type == it->second);
    CHECK(slot.typing == Typing::Strict);
  }
}

}  // namespace lockstep::host::test
