// What a skipped child, or member, means to each kind: it is as if it were not there in the tick.
#include <catch2/catch.hpp>

#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kOrdered[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"Sequence goes on after a skipped child",
   "Sequence(a b c)", "a=S b=K c=S", "S[a b c]"},
  {"Sequence is skipped when all its children were",
   "Sequence(a b)", "a=K b=K", "K[a b]"},
  {"Sequence without memory asks the skipped child again in each tick",
   "Sequence(a b)", "a=KKF b=RRS", "R[a b] R[a b] F[a] halt[b]"},
  {"Sequence with memory does not, in this activation",
   "Sequence[memory=true](a b)", "a=KF b=RS", "R[a b] S[b] F[a]"},
  {"Sequence with memory counts the skipped children of its activation",
   "Sequence[memory=true](a b)", "a=K b=RK", "R[a b] K[b]"},
  {"a skipped child counts as done for the progress of a Sequence",
   "Sequence[memory=true](a b)", "a=K b=R.5", "R[a b]=.75"},
  {"Fallback goes on after a skipped child",
   "Fallback(a b c)", "a=F b=K c=S", "S[a b c]"},
  {"Fallback is skipped when all its children were",
   "Fallback(a b)", "a=K b=K", "K[a b]"},
  {"Fallback fails when the others failed",
   "Fallback(a b)", "a=K b=F", "F[a b]"},
};

constexpr TickRow kSkippedParallels[] = {
  {"Parallel: the others decide",
   "Parallel(a b)", "a=K b=S", "S[a b]"},
  {"Parallel is skipped when all its children were in one tick",
   "Parallel(a b)", "a=K b=K", "K[a b]"},
  {"Parallel asks a skipped child again in each tick",
   "Parallel(a b)", "a=KRS b=RRS", "R[a b] R[a b] S[a b]"},
  {"success_count is at most the number of those that are there",
   "Parallel[success_count=2](a b c)", "a=K b=K c=RS", "R[a b c] S[a b c]"},
  {"Parallel fails when too few are there to succeed",
   "Parallel[failure_count=2](a b)", "a=K b=F", "F[a b]"},
  {"the progress of a Parallel is that of those that are there",
   "Parallel(a b c)", "a=K b=R.5 c=R.25", "R[a b c]=.25"},
  {"with success_count too",
   "Parallel[success_count=2](a b c)", "a=K b=R.5 c=R.25", "R[a b c]=.25"},
  {"ParallelAbsolute: nobody waits for a skipped child",
   "ParallelAbsolute[barriers=.5](a b)", "a=K b=R.6R.7S", "R[a b]=.6 R[a b]=.7 S[a b]"},
  {"ParallelAbsolute: a child that is there again is waited for",
   "ParallelAbsolute[barriers=.5](a b)", "a=KR.1R.5S b=R.6R.7S",
   "R[a b] R[a b] R[a] pause[b] S[a b] resume[b]"},
  {"ParallelAbsolute is skipped when all its children were",
   "ParallelAbsolute[barriers=.5](a b)", "a=K b=K", "K[a b]"},
  {"ParallelRelative: nobody waits for a skipped child",
   "ParallelRelative[delta=0](a b)", "a=K b=R.6R.7S", "R[a b]=.6 R[a b]=.7 S[a b]"},
  {"ParallelRelative: a child that is there again is waited for",
   "ParallelRelative[delta=0](a b)", "a=KR.1S b=R.6R.7S",
   "R[a b] R[a b] R[a] pause[b] S[b] resume[b]"},
};

constexpr TickRow kSkippedDecorators[] = {
  {"Inverter passes it on", "Inverter(a)", "a=K", "K[a]"},
  {"ForceSuccess passes it on", "ForceSuccess(a)", "a=K", "K[a]"},
  {"ForceFailure passes it on", "ForceFailure(a)", "a=K", "K[a]"},
  {"SubTree passes it on", "SubTree(a)", "a=K", "K[a]"},
  {"Repeat passes it on, and begins again with the first round",
   "Repeat[times=2](a)", "a=SKSS", "R[a]=.5 K[a] R[a]=.5 S[a]"},
  {"Retry passes it on, and begins again with the first attempt",
   "Retry[attempts=2](a)", "a=FKFF", "R[a] K[a] R[a] F[a]"},
  {"Timeout passes it on, and its time begins again",
   "Timeout[seconds=.2](a)", "a=RKRRR", "R[a] K[a] R[a] R[a] F[] halt[a]"},
  {"Delay passes it on, and waits again",
   "Delay[seconds=.1](a)", "a=KS", "R[] K[a] R[] S[a]"},
  {"RunOnce passes it on, and has not run",
   "RunOnce(a)", "a=KSF", "K[a] S[a] S[]"},
  {"KeepRunningUntilFailure goes on",
   "KeepRunningUntilFailure(a)", "a=KSF", "R[a] R[a] F[a]"},
  {"IfThenElse is skipped when its condition is",
   "IfThenElse(c a b)", "c=K a=S b=S", "K[c]"},
  {"IfThenElse is skipped when its branch is, and then asks again",
   "IfThenElse(c a b)", "c=SF a=K b=S", "K[c a] S[c b]"},
  {"WhileDoElse is skipped when its condition is, and halts the branch",
   "WhileDoElse(c a b)", "c=SK a=R b=S", "R[c a] K[c] halt[a]"},
};

constexpr TickRow kMembers[] = {
  {"SyncProgress passes it on, and nobody waits for it",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=KKR.1 b=R.6R.7R.8", "R[a b] R[a b] R[a b] R[a] pause[b]"},
  {"a member behind which its Sequence went on is not waited for, also with idle=wait",
   "Parallel(Sequence[memory=true](SyncProgress[barrier=g](a) c) SyncProgress[barrier=g](b)) "
   "barrier[name=g barriers=.5]", "a=K c=R b=R.6R.7S", "R[a c b] R[c b] R[c b]"},
  {"a member that was never reached is waited for",
   "Parallel(Sequence[memory=true](c SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b)) "
   "barrier[name=g barriers=.5]", "a=S c=RRS b=R.6R.7S", "R[c b] R[c] pause[b] R[c a] R[b] resume[b]"},
  {"UseResources passes it on, and gives back what it owns in the same tick",
   "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)) resources[name=p]",
   "a=KR b=RS", "R[a b] R[b]"},
};
// clang-format on

}  // namespace

TEST_CASE("a skipped child of Sequence and Fallback") {
  check_rows(kOrdered);
}

TEST_CASE("a skipped child of the parallels") {
  check_rows(kSkippedParallels);
}

TEST_CASE("a skipped child of other nodes") {
  check_rows(kSkippedDecorators);
}

TEST_CASE("a skipped member of a barrier or a pool") {
  check_rows(kMembers);
}

}  // namespace lockstep::host::test
