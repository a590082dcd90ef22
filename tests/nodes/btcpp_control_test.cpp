// The control nodes of trees for BehaviorTree.CPP.
#include <catch2/catch.hpp>

#include "dialect/btcpp/rules.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kSequences[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"Sequence: goes on with the child at which it stopped",
   "Sequence(a b)", "a=S b=RS", "R[a b] S[b]"},
  {"Sequence: a Failure resets all, and the next activation begins with the first child",
   "Sequence(a b)", "a=S b=RFR", "R[a b] F[b] R[a b]"},
  {"Sequence: a skipped child counts as not there",
   "Sequence(a b c)", "a=S b=K c=S", "S[a b c]"},
  {"Sequence: is skipped when all children were",
   "Sequence(a b)", "a=K b=K", "K[a b]"},
  {"Sequence: counts over the ticks of an activation which children were skipped",
   "Sequence(a b)", "a=K b=RK", "R[a b] K[b]"},
  {"Sequence: begins with the first child after it was skipped",
   "Sequence(a b)", "a=KS b=KS", "K[a b] S[a b]"},
  {"Sequence: halted, it begins with the first child",
   "ReactiveSequence(c Sequence(a b))", "c=SFS a=S b=R", "R[c a b] F[c] halt[b] R[c a b]"},
  {"Fallback: goes on with the child at which it stopped",
   "Fallback(a b)", "a=F b=RS", "R[a b] S[b]"},
  {"Fallback: a Success ends it",
   "Fallback(a b c)", "a=F b=S c=S", "S[a b]"},
  {"Fallback: fails when all fail or are skipped",
   "Fallback(a b)", "a=K b=F", "F[a b]"},
  {"Fallback: is skipped when all children were",
   "Fallback(a b)", "a=K b=K", "K[a b]"},

  {"ReactiveSequence: ticks from the first child in every tick",
   "ReactiveSequence(a b)", "a=S b=RRS", "R[a b] R[a b] S[a b]"},
  {"ReactiveSequence: a child that runs halts those behind it, after it was ticked",
   "ReactiveSequence(a b)", "a=SR b=R", "R[a b] R[a] halt[b]"},
  {"ReactiveSequence: a Failure halts what runs",
   "ReactiveSequence(a b)", "a=SF b=R", "R[a b] F[a] halt[b]"},
  {"ReactiveSequence: a skipped child counts as not there",
   "ReactiveSequence(a b)", "a=K b=RS", "R[a b] S[a b]"},
  {"ReactiveSequence: is skipped when all were in one tick",
   "ReactiveSequence(a b)", "a=K b=RK", "R[a b] K[a b]"},
  {"ReactiveFallback: ticks from the first child in every tick",
   "ReactiveFallback(a b)", "a=F b=RRF", "R[a b] R[a b] F[a b]"},
  {"ReactiveFallback: a Success halts what runs",
   "ReactiveFallback(a b)", "a=FS b=R", "R[a b] S[a] halt[b]"},
  {"ReactiveFallback: a child that runs halts those behind it",
   "ReactiveFallback(a b)", "a=FR b=R", "R[a b] R[a] halt[b]"},

  {"AsyncSequence: after a child that succeeds at once, the tree is ticked again",
   "ReactiveSequence(c AsyncSequence(a b))", "c=S a=S b=S", "S[c a c b]"},
  {"AsyncSequence: not after the last child",
   "AsyncSequence(a)", "a=S", "S[a]"},
  {"AsyncSequence: not after a child that ran before",
   "ReactiveSequence(c AsyncSequence(a b))", "c=S a=RS b=S", "R[c a] S[c a b]"},
  {"AsyncSequence: not after a child that was skipped",
   "ReactiveSequence(c AsyncSequence(a b))", "c=S a=K b=S", "S[c a b]"},
  {"AsyncSequence: a Failure ends it, and the next activation begins with the first child",
   "AsyncSequence(a b)", "a=S b=FS", "F[a b] S[a b]"},
  {"AsyncSequence: is skipped when all children were",
   "AsyncSequence(a b)", "a=K b=K", "K[a b]"},
  {"AsyncFallback: after a child that fails at once, the tree is ticked again",
   "ReactiveSequence(c AsyncFallback(a b))", "c=S a=F b=S", "S[c a c b]"},
  {"AsyncFallback: not after the last child",
   "ReactiveSequence(c AsyncFallback(a b))", "c=S a=F b=F", "F[c a c b]"},

  {"SequenceWithMemory: goes on with the child that failed",
   "SequenceWithMemory(a b)", "a=S b=FS", "F[a b] S[b] S[a b]"},
  {"SequenceWithMemory: keeps its place when it is halted",
   "ReactiveSequence(c SequenceWithMemory(a b))", "c=SSFSS a=S b=RS", "R[c a c b] F[c] halt[b] S[c b]"},
  {"SequenceWithMemory: a second activation that skips the rest succeeds",
   "SequenceWithMemory(a b)", "a=K b=FK", "F[a b] S[b]"},
  {"SequenceWithMemory: is skipped when all children were in one activation",
   "SequenceWithMemory(a b)", "a=K b=K", "K[a b]"},

  {"Sequences have the share of their done children, and of the one that runs, as progress",
   "SequenceWithMemory(a b)", "a=S b=R.5", "R[a b]=.75"},
};

constexpr TickRow kParallels[] = {
  {"Parallel: all must succeed",
   "Parallel(a b)", "a=S b=RS", "R[a b] S[b]"},
  {"Parallel: one Failure ends it and halts what runs",
   "Parallel(a b)", "a=R b=F", "F[a b] halt[a]"},
  {"Parallel: children to the right of the one that decides are not ticked",
   "Parallel[success_count=1](a b)", "a=S b=S", "S[a]"},
  {"Parallel: success_count children must succeed",
   "Parallel[success_count=2](a b c)", "a=S b=RS c=R", "R[a b c] S[b] halt[c]"},
  {"Parallel: failure_count children must fail",
   "Parallel[success_count=1 failure_count=2](a b c)", "a=F b=R c=RF", "R[a b c] F[b c] halt[b]"},
  {"Parallel: fails when success cannot be reached any more",
   "Parallel[success_count=2 failure_count=3](a b c)", "a=F b=F c=R", "F[a b]"},
  {"Parallel: a negative count is counted from all",
   "Parallel[success_count=-2](a b)", "a=S b=R", "S[a]"},
  {"Parallel: a negative failure_count is counted from all",
   "Parallel[success_count=1 failure_count=-1](a b)", "a=F b=RF", "R[a b] F[b]"},
  {"Parallel: with success_count 0 the first child ends it",
   "Parallel[success_count=0](a b)", "a=F b=S", "S[a]"},
  {"Parallel: with failure_count 0 the first child that does not give success ends it",
   "Parallel[success_count=2 failure_count=0](a b)", "a=S b=S", "F[a]"},
  {"Parallel: skipped children count for a negative success_count",
   "Parallel(a b)", "a=K b=S", "S[a b]"},
  {"Parallel: with a positive success_count a skipped child is waited for",
   "Parallel[success_count=2](a b)", "a=K b=S", "R[a b] R[a] R[a]"},
  {"Parallel: is skipped when all children are in one tick",
   "Parallel[success_count=2](a b)", "a=KS b=K", "K[a b] R[a b]"},
  {"Parallel: forgets when it is halted",
   "ReactiveSequence(c Parallel(a b))", "c=SFS a=S b=R", "R[c a b] F[c] halt[b] R[c a b]"},

  {"ParallelAll: ticks all children until all have completed",
   "ParallelAll(a b c)", "a=F b=RRS c=S", "R[a b c] R[b] F[b]"},
  {"ParallelAll: max_failures children must fail",
   "ParallelAll[max_failures=2](a b c)", "a=F b=S c=S", "S[a b c]"},
  {"ParallelAll: max_failures -1: all must fail",
   "ParallelAll[max_failures=-1](a b)", "a=F b=F", "F[a b]"},
  {"ParallelAll: max_failures 0 always fails",
   "ParallelAll[max_failures=0](a b)", "a=S b=S", "F[a b]"},
  {"ParallelAll: a skipped child counts as done",
   "ParallelAll(a b)", "a=K b=S", "S[a b]"},
  {"ParallelAll: is skipped when all are",
   "ParallelAll(a b)", "a=K b=K", "K[a b]"},
  {"ParallelAll: has the least progress",
   "ParallelAll(a b)", "a=R.5 b=R.2", "R[a b]=.2"},

  {"ParallelRelative: a skipped child holds nobody back",
   "ParallelRelative[delta=.1](a b)", "a=R.5R.8 b=K", "R[a b] R[a b] R[a b]"},
  {"ParallelAbsolute: a skipped child holds nobody back",
   "ParallelAbsolute[barriers=.5](a b)", "a=R.5R.8 b=K", "R[a b] R[a b] R[a b]"},
  {"ParallelAbsolute: succeeds when all others did, is skipped when all were",
   "ParallelAbsolute[barriers=.5](a b)", "a=SK b=K", "S[a b] K[a b]"},
  {"ParallelRelative: one that is no longer skipped is waited for",
   "ParallelRelative[delta=.1](a b)", "a=R.5R.8 b=KR", "R[a b] R[a b] R[b] pause[a]"},
};

constexpr TickRow kBranches[] = {
  {"IfThenElse: the condition chooses the branch, once",
   "IfThenElse(c a b)", "c=S a=RS b=S", "R[c a] S[a]"},
  {"IfThenElse: a failed condition chooses the third child",
   "IfThenElse(c a b)", "c=F a=S b=RF", "R[c b] F[b]"},
  {"IfThenElse: without a third child a failed condition fails it",
   "IfThenElse(c a)", "c=FS a=S", "F[c] S[c a]"},
  {"IfThenElse: waits for a condition that runs",
   "IfThenElse(c a)", "c=RS a=S", "R[c] S[c a]"},
  {"IfThenElse: a skipped branch is its result",
   "IfThenElse(c a)", "c=S a=K", "K[c a]"},
  {"IfThenElse: a skipped condition is a fault",
   "IfThenElse(c a)", "c=K a=S", "X[c]=IfThenElse"},
  {"IfThenElse: has the progress of the branch, 0 while the condition runs",
   "IfThenElse(c a)", "c=R.5S a=R.3", "R[c]=0 R[c a]=.3"},

  {"WhileDoElse: asks a condition in every tick",
   "WhileDoElse(c? a b)", "c=SSF a=R b=S", "R[c a] R[c a] S[c b] halt[a]"},
  {"WhileDoElse: halts the else branch when the condition holds",
   "WhileDoElse(c? a b)", "c=FS a=S b=R", "R[c b] S[c a] halt[b]"},
  {"WhileDoElse: an action that has answered is not asked again while a branch runs",
   "WhileDoElse(c a)", "c=SF a=RRS", "R[c a] R[a] S[a]"},
  {"WhileDoElse: the answer is asked for again in a new activation",
   "WhileDoElse(c a)", "c=SF a=RS", "R[c a] S[a] F[c]"},
  {"WhileDoElse: without a third child a failed condition fails it",
   "WhileDoElse(c? a)", "c=SF a=R", "R[c a] F[c] halt[a]"},
  {"WhileDoElse: while the condition runs, the branch is not ticked",
   "WhileDoElse(Sequence(c?) a)", "c=S a=R", "R[c a] R[c a]"},
  {"WhileDoElse: a skipped branch is its result",
   "WhileDoElse(c? a)", "c=S a=K", "K[c a]"},

  {"Switch: the first case that equals the variable chooses its child",
   "Sequence(Script[code=v:='b'] Switch2[variable={v} case_1=a case_2=b](x y z))",
   "x=S y=F z=S", "F[y]"},
  {"Switch: the last child when no case fits",
   "Sequence(Script[code=v:='q'] Switch2[variable={v} case_1=a case_2=b](x y z))",
   "x=S y=S z=F", "F[z]"},
  {"Switch: the last child without a value",
   "Switch2[variable={v} case_1=a case_2=b](x y z)", "x=S y=S z=F", "F[z]"},
  {"Switch: whole numbers and reals are compared by value",
   "Sequence(Script[code=v:=2] Switch2[variable={v} case_1=1 case_2=02](x y z))",
   "x=S y=F z=S", "F[y]"},
  {"Switch: a real is text with six decimals, and equal within 1.2e-7",
   "Sequence(Script[code=v:=2.5] Switch2[variable={v} case_1=2.50 case_2=b](x y z))",
   "x=F y=S z=S", "F[x]"},
  {"Switch: halts the child that it leaves",
   "Sequence(Script[code=v:=0] ReactiveSequence(Script[code=v+=1] Switch2[variable={v} case_1=1 case_2=2](x y z)))",
   "x=R y=R z=R", "R[x] R[y] halt[x] R[z] halt[y] R[z]"},

  {"TryCatch: succeeds without the last child",
   "TryCatch(a b c)", "a=S b=RS c=S", "R[a b] S[b]"},
  {"TryCatch: a Failure halts nothing more, ticks the last child in the same tick, and fails",
   "TryCatch(a b c)", "a=S b=F c=RS", "R[a b c] F[c]"},
  {"TryCatch: a skipped last child ends it as well",
   "TryCatch(a c)", "a=F c=K", "F[a c]"},
  {"TryCatch: is skipped when all that it tries were",
   "TryCatch(a b c)", "a=K b=K c=S", "K[a b]"},
  {"TryCatch: halted, it does not tick the last child",
   "ReactiveSequence(k TryCatch(a c))", "k=SF a=R c=S", "R[k a] F[k] halt[a]"},
  {"TryCatch: with catch_on_halt it ticks it once",
   "ReactiveSequence(k TryCatch[catch_on_halt=true](a c))", "k=SF a=R c=R", "R[k a] F[k c] halt[a c]"},
  {"TryCatch: with catch_on_halt not when the last child runs already",
   "ReactiveSequence(k TryCatch[catch_on_halt=true](a c))", "k=SF a=F c=R", "R[k a c] F[k] halt[c]"},
};
// clang-format on

}  // namespace

TEST_CASE("BehaviorTree.CPP: sequences and fallbacks") {
  check_rows(kSequences, FaultPolicy::Stop, btcpp::kRules);
}

TEST_CASE("BehaviorTree.CPP: parallels") {
  check_rows(kParallels, FaultPolicy::Stop, btcpp::kRules);
}

TEST_CASE("BehaviorTree.CPP: nodes that choose a child") {
  check_rows(kBranches, FaultPolicy::Stop, btcpp::kRules);
}

}  // namespace lockstep::host::test
