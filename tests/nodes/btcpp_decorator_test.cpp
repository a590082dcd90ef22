// The decorators and leaves of trees for BehaviorTree.CPP, and the scripts around a node.
#include <catch2/catch.hpp>

#include "dialect/btcpp/rules.h"
#include "nodes/btcpp_decorator_laws.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kNames[] = {
  {"SetBlackboard: output_key={k} is the entry whose name is in k",
   "Sequence(Script[code=k:='x'] SetBlackboard[value=5 output_key={k}] ScriptCondition[code=x==5&&k=='x'])",
   "", "S[]"},
  {"SetBlackboard: and what it names may change",
   "Sequence(Script[code=k:='x';x:='';y:=''] Repeat[num_cycles=2](Sequence(SetBlackboard[value=1 output_key={k}] Script[code=k:='y']))"
   " ScriptCondition[code=x==1&&y==1])",
   "", "S[]"},
  {"SetBlackboard: a number is a name, too",
   "Sequence(Script[code=k:=7] SetBlackboard[value=1 output_key={k}] a)", "a=S", "S[a]"},
  {"SetBlackboard: an entry that only names mean at run time",
   "Sequence(Script[code=k:='a.b'] SetBlackboard[value=1 output_key={k}]"
   " SetBlackboard[value={a.b} output_key=c] ScriptCondition[code=c==1])",
   "", "S[]"},
  {"SetBlackboard: without a name it is a fault",
   "SetBlackboard[value=5 output_key={k}]", "", "X[]=SetBlackboard"},
  {"UnsetBlackboard: key={k} removes the entry whose name is in k",
   "Sequence(Script[code=k:='x';x:=1] UnsetBlackboard[key={k}] a Script[code=x=2])", "a=S", "X[a]=Script"},
  {"UnsetBlackboard: without a name it is a fault",
   "UnsetBlackboard[key={k}]", "", "X[]=UnsetBlackboard"},
  {"UnsetBlackboard: @k is not an entry of this tree",
   "Sequence(Script[code=x:=1] UnsetBlackboard[key=@x] ScriptCondition[code=x==1])", "", "S[]"},

  {"Script: code={k} is the script in k, compiled again when it changes",
   "Sequence(Script[code=n:=0;k:='n+=1'] Script[code={k}] Script[code={k}] Script[code=k:='n*=2']"
   " Script[code={k}] ScriptCondition[code=n==4])",
   "", "S[]"},
  {"Script: an empty one does nothing",
   "Sequence(Script[code=k:=''] Script[code={k}] Script[code=] a)", "a=S", "S[a]"},
  {"Script: code={k} may change its own text",
   "Sequence(Script[code=n:=0] SetBlackboard[value=n:=1;k:='n:=2' output_key=k] Script[code={k}]"
   " Script[code={k}] ScriptCondition[code=n==2])",
   "", "S[]"},
  {"Script: code={k} has the entries of its new text alone, when that changes",
   "Sequence(Script[code=n:=0;m:=0;k:='n:=1'] Repeat[num_cycles=2](Sequence(Script[code={k}]"
   " Script[code=k:='m:=5'])) ScriptCondition[code=n==1&&m==5])",
   "", "S[]"},
  {"Script: code={k} makes entries that nothing else names",
   "Sequence(SetBlackboard[value=fresh:=1 output_key=k] Script[code={k}]"
   " SetBlackboard[value=fresh==1 output_key=k] ScriptCondition[code={k}])",
   "", "S[]"},
  {"Script: code={k} without a value, or that does not parse, is a fault",
   "Sequence(a Script[code={k}])", "a=S", "X[a]=Script"},
  {"Script: code={k} that does not parse is a fault",
   "Sequence(Script[code=k:='n:='] a Script[code={k}])", "a=S", "X[a]=Script"},
  {"ScriptCondition: code={k} is a condition, and not empty",
   "Sequence(Script[code=k:='1'] ScriptCondition[code={k}] a Script[code=k:=''] ScriptCondition[code={k}])",
   "a=S", "X[a]=ScriptCondition"},
  {"Precondition: if={k} and else={e}",
   "Sequence(Script[code=k:='n==1';e:='SUCCESS';n:=0] Precondition[if={k} else={e}](a)"
   " Script[code=n:=1] Precondition[if={k} else={e}](b))",
   "a=F b=S", "S[b]"},
  {"Precondition: only else is an entry",
   "Sequence(Script[code=n:=2;e:='SUCCESS'] Precondition[if=n==1 else={e}](a))", "a=F", "S[]"},
  {"names: a run that begins again has none of the last one",
   "Sequence(SetBlackboard[value=x output_key=k] Inverter(WasEntryUpdated[entry={x}]) SetBlackboard[value=1 output_key={k}] a)",
   "a=R", "R[a]"},
  {"WasEntryUpdated: entry=n is only a name, and makes no entry",
   "Sequence(Inverter(WasEntryUpdated[entry=n]) Script[code=n=1])", "", "X[]=Script"},
  {"WasEntryUpdated: entry={n} makes it",
   "Sequence(Inverter(WasEntryUpdated[entry={n}]) Script[code=n=1] WasEntryUpdated[entry=n])", "", "S[]"},
};

constexpr TickRow kBtcppHooks[] = {
  {"_failureIf, _successIf and _skipIf give the result without a tick, asked in this order",
   "Sequence(a[_skipIf=1 _successIf=1] Inverter(b[_successIf=1 _failureIf=1 _skipIf=1]) c[_skipIf=1] d)",
   "a=F b=R c=F d=S", "S[d]"},
  {"they are asked only when the node does not run",
   "Sequence(Script[code=n:=0] ReactiveSequence(Script[code=n+=1] a[_skipIf=n>1]))",
   "a=RRS", "R[a] R[a] S[a]"},
  {"_while false skips a node that is idle",
   "Sequence(a[_while=0] b)", "a=S b=S", "S[b]"},
  {"_while false halts a node that runs, and it is skipped",
   "Sequence(Script[code=n:=0] ReactiveSequence(Script[code=n+=1] a[_while=n<2] b))",
   "a=R b=S", "R[a] S[b] halt[a]"},
  {"_while false halts all that runs in the node",
   "Sequence(Script[code=n:=0] ReactiveSequence(Script[code=n+=1] Parallel[_while=n<2](a b) c))",
   "a=R b=R c=S", "R[a b] S[c] halt[a b]"},
  {"_onSuccess or _onFailure, then _post, run when the node completes",
   "Sequence(Script[code=t:=''] a[_onSuccess=t=t..'s' _onFailure=t=t..'f' _post=t=t..'p'] ScriptCondition[code=t=='sp'])",
   "a=RS", "R[a] S[a]"},
  {"_onFailure of a node that _failureIf ends",
   "Fallback(Sequence(Script[code=t:=''] a[_failureIf=1 _onFailure=t='f']) ScriptCondition[code=t=='f'])",
   "a=S", "S[]"},
  {"scripts of children run before those of their parent",
   "Sequence(Script[code=t:=''] Sequence[_onSuccess=t=t..'p'](a[_onSuccess=t=t..'c']) ScriptCondition[code=t=='cp'])",
   "a=S", "S[a]"},
  {"no _post after a skip",
   "Sequence(Script[code=t:=''] a[_post=t='p'] ScriptCondition[code=t==''])", "a=K", "S[a]"},
  {"_onHalted runs after a halt, children before their parent, from the left",
   "ReactiveSequence(RunOnce(Script[code=t:='']) Fallback(k? ScriptCondition[code=t=='abp'])"
   " Parallel[_onHalted=t=t..'p'](a[_onHalted=t=t..'a'] b[_onHalted=t=t..'b']))",
   "k=SF a=R b=R", "R[k a b] F[k] halt[a b] R[k a b]"},
  {"_onHalted does not run for a node that is idle",
   "ReactiveSequence(RunOnce(Script[code=t:='']) ScriptCondition[code=t==''] k a[_onHalted=t='a'])",
   "k=R a=R", "R[k] R[k]"},
  {"a script that fails is a fault of its node",
   "Sequence(a[_skipIf=n])", "a=S", "X[]=a"},
  {"a script after a tick that fails is a fault of its node",
   "Sequence(a[_post=n+=1])", "a=S", "X[a]=a"},
};

constexpr TickRow kTolerated[] = {
  {"a script that fails makes its node fail, when faults are tolerated",
   "Fallback(a[_skipIf=n] b)", "a=S b=S", "S[b]!a"},
  {"_while that fails halts what runs",
   "Fallback(Sequence(Script[code=n:=0] ReactiveSequence(Script[code=n+=1] a[_while=n])) b)",
   "a=R b=S", "R[a] S[b]!a halt[a]"},
};
// clang-format on

}  // namespace

TEST_CASE("BehaviorTree.CPP: decorators and leaves") {
  check_rows(kDecorators, FaultPolicy::Stop, btcpp::kRules);
}

TEST_CASE("BehaviorTree.CPP: names and scripts that are in entries") {
  check_rows(kNames, FaultPolicy::Stop, btcpp::kRules);
}

TEST_CASE("BehaviorTree.CPP: scripts around a node") {
  check_rows(kBtcppHooks, FaultPolicy::Stop, btcpp::kRules);
  check_rows(kTolerated, FaultPolicy::Fail, btcpp::kRules);
}

}  // namespace lockstep::host::test
