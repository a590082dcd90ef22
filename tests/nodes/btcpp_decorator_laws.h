// What the decorators and leaves of trees for BehaviorTree.CPP do: as nodes of a tree, and as
// objects that a program makes by hand.
#pragma once

#include "support/tick_row.h"

namespace lockstep::host::test {

// clang-format off
inline constexpr TickRow kDecorators[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"Inverter, ForceSuccess and ForceFailure pass a skipped child on",
   "Sequence(Inverter(a) ForceSuccess(b) ForceFailure(c))", "a=K b=K c=K", "K[a b c]"},

  {"Repeat: a child that succeeds at once lets the tree be ticked again",
   "ReactiveSequence(c Repeat[num_cycles=2](a))", "c=S a=S", "S[c a c a]"},
  {"Repeat: a child that ran before is ticked again in the same tick",
   "ReactiveSequence(c Repeat[num_cycles=2](a))", "c=S a=RSR", "R[c a] R[c a a]"},
  {"Repeat: a Failure ends it, and the rounds begin again",
   "Repeat[num_cycles=2](a)", "a=SFSS", "F[a a] S[a a]"},
  {"Repeat: num_cycles 0, and less than -1, is Success without a tick",
   "Sequence(Repeat[num_cycles=0](a) Repeat[num_cycles=-2](b))", "a=F b=F", "S[]"},
  {"Repeat: num_cycles -1 is for ever",
   "Repeat[num_cycles=-1](a)", "a=RSRSRF", "R[a] R[a a] R[a a] F[a]"},
  {"Repeat: keeps its rounds while its child is skipped",
   "Repeat[num_cycles=3](a)", "a=SSKS", "K[a a a] S[a]"},
  {"Repeat: forgets its rounds when its parent begins again",
   "Sequence(Repeat[num_cycles=2](a) b)", "a=SKS b=S", "S[a a b] S[a a b]"},
  {"Repeat: forgets its rounds when it is halted",
   "ReactiveSequence(c Repeat[num_cycles=2](a))", "c=SSFSS a=SRSS",
   "R[c a c a] F[c] halt[a] S[c a c a]"},
  {"Repeat: has the share of the rounds that are over as progress",
   "Repeat[num_cycles=4](a)", "a=SR.5", "R[a a]=.375"},

  {"RetryUntilSuccessful: a child that fails at once lets the tree be ticked again",
   "ReactiveSequence(c RetryUntilSuccessful[num_attempts=3](a))", "c=S a=FS", "S[c a c a]"},
  {"RetryUntilSuccessful: fails after num_attempts failures",
   "RetryUntilSuccessful[num_attempts=2](a)", "a=FFS", "F[a a] S[a]"},
  {"RetryUntilSuccessful: has the progress of this attempt",
   "RetryUntilSuccessful[num_attempts=3](a)", "a=R.5FR.25S", "R[a]=.5 R[a a]=.25 S[a]=1"},
  {"RetryUntilSuccessful: num_attempts 0, and less than -1, is Failure without a tick",
   "Fallback(RetryUntilSuccessful[num_attempts=0](a) RetryUntilSuccessful[num_attempts=-2](b))", "a=S b=S", "F[]"},
  {"RetryUntilSuccessful: num_attempts -1 is for ever",
   "RetryUntilSuccessful[num_attempts=-1](a)", "a=RFRFRS", "R[a] R[a a] R[a a] S[a]"},
  {"RetryUntilSuccessful: reads num_attempts again after each failure",
   "Sequence(Script[code=n:=5] RetryUntilSuccessful[num_attempts={n}](Sequence(Script[code=n:=2] a)))",
   "a=F", "F[a a]"},

  {"KeepRunningUntilFailure: a child that succeeds is started again in the next tick",
   "KeepRunningUntilFailure(a)", "a=SSF", "R[a] R[a] F[a]"},
  {"KeepRunningUntilFailure: runs while its child is skipped",
   "KeepRunningUntilFailure(a)", "a=KF", "R[a] F[a]"},

  {"RunOnce: is skipped once its child has completed",
   "RunOnce(a)", "a=F", "F[a] K[] K[]"},
  {"RunOnce: with then_skip false it gives the result again",
   "RunOnce[then_skip=false](a)", "a=F", "F[a] F[]"},
  {"RunOnce: a child that was skipped or halted has not completed",
   "ReactiveSequence(c RunOnce(a))", "c=SSFSS a=KRS", "S[c a] R[c a] F[c] halt[a] S[c a] S[c]"},

  {"Delay: waits from its first tick on, then ticks its child",
   "Delay[delay_msec=200](a)", "a=RS", "R[] R[] R[a] S[a] R[]"},
  {"Delay: a child that is skipped does not begin the wait again",
   "Delay[delay_msec=100](a)", "a=KS", "R[] K[a] S[a]"},
  {"Delay: halted, it waits again",
   "ReactiveSequence(c Delay[delay_msec=200](a))", "c=SFSSS a=S", "R[c] F[c] R[c] R[c] S[c a]"},

  {"Timeout: halts its child at the first tick at or after the time",
   "Timeout[msec=200](a)", "a=R", "R[a] R[a] F[] halt[a] R[a]"},
  {"Timeout: 0 is for ever",
   "Timeout[msec=0](a)", "a=RRS", "R[a] R[a] S[a]"},
  {"Timeout: a skipped child lets the time go on",
   "Timeout[msec=200](a)", "a=KRR", "K[a] R[a] F[] halt[a]"},
  {"Timeout: a child that begins after the time is over runs as long as it likes",
   "Timeout[msec=200](a)", "a=KKKRRRS", "K[a] K[a] K[a] R[a] R[a] R[a] S[a]"},
  {"Timeout: counts again after its child has completed",
   "Timeout[msec=200](a)", "a=RSR", "R[a] S[a] R[a] R[a] F[] halt[a]"},

  {"Precondition: asks until it has ticked its child, then no more",
   "Sequence(Script[code=n:=1] Precondition[if=n==1](Sequence(Script[code=n:=2] a)))", "a=RS", "R[a] S[a]"},
  {"Precondition: the result is 'else' while it is false",
   "Sequence(Script[code=n:=1] Precondition[if=n==2 else=SUCCESS](a))", "a=R", "S[]"},
  {"Precondition: 'else' is FAILURE by default",
   "Sequence(Script[code=n:=1] Precondition[if=n==2](a))", "a=R", "F[]"},
  {"Precondition: 'else' may be SKIPPED or RUNNING",
   "Sequence(Script[code=n:=1] Precondition[if=n==2 else=SKIPPED](a) Precondition[if=n==2 else=RUNNING](b))",
   "a=R b=R", "R[]"},
  {"Precondition: asks again after it was halted",
   "ReactiveSequence(c Precondition[if=1](a))", "c=SFS a=R", "R[c a] F[c] halt[a] R[c a]"},

  {"SkipUnlessUpdated: ticks its child once for each write",
   "ReactiveSequence(SkipUnlessUpdated[entry=n](a) b)", "a=S b=R", "R[b]"},
  {"SkipUnlessUpdated: any write counts, also of the same value",
   "ReactiveSequence(Script[code=n:=1] SkipUnlessUpdated[entry=n](a) b)", "a=S b=R", "R[a b] R[a b]"},
  {"SkipUnlessUpdated: goes on with a child that runs",
   "ReactiveSequence(RunOnce(Script[code=n:=1]) SkipUnlessUpdated[entry=n](a))", "a=RRS", "R[a] R[a] S[a] K[]"},
  {"WaitValueUpdate: runs until the entry is written",
   "ReactiveSequence(RunOnce(Script[code=n:=1]) WaitValueUpdate[entry=n](a))", "a=S", "S[a] R[]"},
  {"WasEntryUpdated: succeeds when the entry was written since it asked",
   "ReactiveSequence(RunOnce(Script[code=n:=1]) WasEntryUpdated[entry=n] a)", "a=R", "R[a] F[] halt[a]"},
  {"WasEntryUpdated: no entry, no write",
   "WasEntryUpdated[entry=n]", "", "F[]"},

  {"Sleep: runs until its time is over",
   "Sleep[msec=200]", "", "R[] R[] S[]"},
  {"Sleep: 0 is over at once",
   "Sleep[msec=0]", "", "S[]"},
  {"Sleep: has the share of its time as progress",
   "Sleep[msec=400]", "", "R[]=0 R[]=.25"},
  {"Script: succeeds; ScriptCondition: what its value says",
   "Sequence(Script[code=n:=0] ScriptCondition[code=n==0] ScriptCondition[code=n>0])", "", "F[]"},
  {"ScriptCondition: a value that is no condition is a fault",
   "ScriptCondition[code=2]", "", "X[]=ScriptCondition"},
  {"Script: an entry that is not there is a fault",
   "Script[code=n:=m]", "", "X[]=Script"},
};
// clang-format on

}  // namespace lockstep::host::test
