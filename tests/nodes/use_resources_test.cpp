// Resources: who owns what in which tick.
#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/blackboard.h"
#include "engine/resources.h"
#include "support/scripted_run.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

struct ResourceTrace {
  std::string_view tree, leaves;
  std::string_view
      who;  // digit: that leaf is ticked; '-': it runs and is held; '.': it does not run
};

// clang-format off
constexpr ResourceTrace kResourceTraces[] = {
  {"Parallel(UseResources[pool=p resources=A;B](a) UseResources[pool=p resources=B;C](b)"
   " UseResources[pool=p resources=A;C](c)) resources[name=p increment=0]",
   "a+.1 b+.1 c+.1",
   "1.. 1.. 1.. 1.. 1.. 1.. 1.. 1.. 1.. 1.. .2. .2. .2. .2. .2. .2. .2. .2. .2. .2. "
   "..3 ..3 ..3 ..3 ..3 ..3 ..3 ..3 ..3 ..3"},
  {"Parallel(UseResources[pool=p resources=A;B](a) UseResources[pool=p resources=B;C](b)"
   " UseResources[pool=p resources=A;C](c)) resources[name=p increment=1]",
   "a+.1 b+.1 c+.1",
   "1.. -2. --3 1-- -2- --3 1-- -2- --3 1-- -2- --3 1-- -2- --3 1-- -2- --3 1-- -2- --3 "
   "1-- -2- --3 1-- -2- --3 1-- .2- ..3"},
  {"Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=B](b)"
   " UseResources[pool=p resources=A;B](c) UseResources[pool=p resources=C](d))"
   " resources[name=p increment=1]",
   "a=RRRRRS b=RRRRRS c=RRRRRS d=RRRRRS",
   "12.4 --34 12-4 --34 12-4 --34 12-. --3. 12-. --3. 12-. ..3."},
  {"Parallel(UseResources[pool=p resources=A keep=true](a) UseResources[pool=p resources=A](b))"
   " resources[name=p]",
   "a=RRRS b=RRS", "1. 1. 1. 1. .2 .2 .2"},
};

constexpr TickRow kResourceRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"ticks both children where their resources are disjoint",
   "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=B](b)) resources[name=p]",
   "a=R b=R", "R[a b] R[a b]"},
  {"pauses a child that runs when it has to wait, and resumes it",
   "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)) resources[name=p]",
   "a=R b=R", "R[a] R{pause a, start b, tick b} R{resume a, tick a, pause b}"},
  {"returns what its child returns, and frees its resources for the next tick",
   "Sequence[memory=true](UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)) resources[name=p]",
   "a=RS b=F", "R[a] R[a] F[b]"},
  {"a member that is first reached asks in that tick",
   "Parallel(UseResources[pool=p resources=A](a) Sequence[memory=true](c UseResources[pool=p resources=B](b))) resources[name=p]",
   "a=R c=S b=R", "R[a c b]"},
  {"one that asks in the tick comes after those that were there before",
   "Parallel(Sequence[memory=true](c UseResources[pool=p resources=A](a)) UseResources[pool=p resources=A](b)) resources[name=p increment=0]",
   "a=R c=RS b=R", "R[c b] R[c b] R[a] pause[b]"},
  {"a halted member gives back what it owns for the next tick, also with keep",
   "Parallel[success_count=1 failure_count=2](Sequence(g? UseResources[pool=p resources=A keep=true](a)) UseResources[pool=p resources=A](b)) resources[name=p]",
   "g=SSF a=R b=R", "R[g a] R[g a] R[g] halt[a] R[b]"},
  {"a child that is skipped at once has not used its resources: they are free in the same tick",
   "Parallel[failure_count=2](UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)) resources[name=p]",
   "a=KR b=R", "R[a b] R[b]"},
  {"a child that is skipped after it has run has used its resources: they are free in the next tick",
   "Parallel[failure_count=2](UseResources[pool=p resources=A](a) Sequence[memory=true](c UseResources[pool=p resources=A](b))) resources[name=p]",
   "a=RK c=RS b=R", "R[a c] R{tick a, tick c} R[b]"},
  {"the same with keep",
   "Parallel[failure_count=2](UseResources[pool=p resources=A keep=true](a) Sequence[memory=true](c UseResources[pool=p resources=A](b))) resources[name=p]",
   "a=RK c=RS b=R", "R[a c] R{tick a, tick c} R[b]"},
  {"two pools do not know each other",
   "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=q resources=A](b)) resources[name=p] resources[name=q]",
   "a=R b=R", "R[a b] R[a b]"},
  {"has the progress of its child",
   "UseResources[pool=p resources=A](a) resources[name=p]", "a=R.4", "R[a]=.4"},
  {"a member that a parallel holds neither owns nor waits, and asks when a tick reaches it again",
   "ParallelAbsolute[barriers=.5](UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)) resources[name=p increment=0]",
   "a=R.5 b=R.2R.5R.6",
   "R[a] R[] pause[a] R[b] R[b] R[b]"},
  {"a member that a barrier holds neither owns nor waits: it is above",
   "Parallel(SyncProgress[barrier=g](UseResources[pool=p resources=A](a)) SyncProgress[barrier=g](UseResources[pool=p resources=A](b)))"
   " barrier[name=g barriers=.5] resources[name=p increment=0]",
   "a=R.5 b=R.2R.5R.6",
   "R[a] R[b] pause[a] R[b] R[a] resume[a] pause[b]"},
  {"a member that a barrier holds neither owns nor waits: it is below",
   "Parallel(UseResources[pool=p resources=A](SyncProgress[barrier=g](a)) UseResources[pool=p resources=A](SyncProgress[barrier=g](b)))"
   " barrier[name=g barriers=.5] resources[name=p increment=0]",
   "a=R.5 b=R.2R.5R.6",
   "R[a] R[b] pause[a] R[b] R[a] resume[a] pause[b]"},
  {"a member inside of one of another pool owns only while that owns",
   "Parallel(UseResources[pool=q resources=Z](UseResources[pool=p resources=A](a)) UseResources[pool=q resources=Z](b) UseResources[pool=p resources=A](c))"
   " resources[name=p increment=0] resources[name=q]",
   "a=R b=R c=R",
   "R[a] R[b c] pause[a] R[a] resume[a] pause[b c] R[b c] pause[a] resume[b c]"},
  {"a node between a member and a held SyncProgress goes on: a Timeout",
   "Parallel[success_count=1 failure_count=2](UseResources[pool=p resources=A](Timeout[seconds=.1](SyncProgress[barrier=g](a))) SyncProgress[barrier=g](b))"
   " barrier[name=g barriers=.5] resources[name=p]",
   "a=R.6 b=R.1", "R[a b] R[b] halt[a]"},
  {"a child that fails ends its member",
   "Fallback[memory=true](UseResources[pool=p resources=A](a) b) resources[name=p]", "a=RF b=S", "R[a] S[a b]"},
  {"a completed member starts again with the priority 0",
   "Parallel(Repeat(UseResources[pool=p resources=A](a)) UseResources[pool=p resources=A](b)) resources[name=p]",
   "a=S b=R", "R[a] R[b] R[a] pause[b] R[b] resume[b]"},
};
// Entries: r is 'A;B' until the leaf a, of 2 ticks, succeeds in the first child; then 'B;C'.
constexpr std::string_view kExchange =
    "Sequence[memory=true](Script[code=r:='A;B'] Parallel(UseResources[pool=p resources={r} on_change=exchange]"
    "(Sequence[memory=true](a[on_success=r='B;C'] b)) %)) resources[name=p resources=A;B;C]";

constexpr TickRow kExchangeRows[] = {
  {"exchange: it gets the new set and is ticked; what it had is free in the next tick",
   "UseResources[pool=p resources=A](x)", "a=RS b=R x=R", "R[a] R[a b] R[b] R[b x]"},
  {"exchange: it keeps the old set while it waits for the new one, and its child is held",
   "UseResources[pool=p resources=C keep=true](x) UseResources[pool=p resources=B](y)", "a=RS b=R x=RRRS y=R",
   "R[a x] R[a b x] R[x] pause[b] R[x] R[b] resume[b]"},
  {"exchange: its own old set never blocks it, whoever waits for it longer",
   "UseResources[pool=p resources=B](y)", "a=RS b=RS y=R", "R[a] R[a b] R[b] R[y]"},
  {"exchange: without a change it keeps what it has",
   "UseResources[pool=p resources=A](x)", "a=RRRR b=R x=R", "R[a] R[a] R[a] R[a]"},
  {"exchange: a halted member gives back both",
   "UseResources[pool=p resources=C keep=true](x) UseResources[pool=p resources=A](y) z", "a=RS b=R x=R y=R z=RRRF",
   "R[a x z] R[a b x z] R[x z] pause[b] F[x z] halt[b x]"},
};

constexpr TickRow kHandoverRows[] = {
  {"two in a row: the second takes over what both need, in the same tick",
   "Parallel(Sequence[memory=true](UseResources[pool=p resources=A;B keep=true](a) UseResources[pool=p resources=B;C keep=true](b))"
   " UseResources[pool=p resources=B](x)) resources[name=p]", "a=RS b=RS x=R", "R[a] R[a b] R[b] R[x]"},
  {"two in a row: the second keeps what both need while it waits for the rest",
   "Parallel(Sequence[memory=true](UseResources[pool=p resources=A;B keep=true](a) UseResources[pool=p resources=B;C keep=true](b))"
   " UseResources[pool=p resources=B](x) UseResources[pool=p resources=C keep=true](y)) resources[name=p]",
   "a=RS b=R x=R y=RRRS", "R[a y] R[a y] R[y] R[y] R[b]"},
  {"two in a row: what the second does not need is free in the next tick",
   "Parallel(Sequence[memory=true](UseResources[pool=p resources=A;B keep=true](a) UseResources[pool=p resources=B;C keep=true](b))"
   " UseResources[pool=p resources=A](x)) resources[name=p]", "a=RS b=R x=R", "R[a] R[a b] R[b x]"},
  {"two in a row, with exchange: the second keeps all that the first has owned until it gets its own",
   "Parallel(Sequence[memory=true](UseResources[pool=p resources=A keep=true](a) UseResources[pool=p resources=B on_change=exchange](b))"
   " UseResources[pool=p resources=A](x) UseResources[pool=p resources=B keep=true](y)) resources[name=p]",
   "a=RS b=R x=R y=RRRS", "R[a y] R[a y] R[y] R[y] R[b] R[b x]"},
  {"two in a row: one that does not keep takes over nothing",
   "Parallel(Sequence[memory=true](UseResources[pool=p resources=A keep=true](a) UseResources[pool=p resources=A](b))"
   " UseResources[pool=p resources=A](x)) resources[name=p]", "a=RS b=R x=RS", "R[a] R[a] R[x]"},
  {"two in a row: other nodes may be around them, and between them in the same tick",
   "Parallel(Sequence[memory=true](SubTree(UseResources[pool=p resources=A keep=true](a)) z Timeout[seconds=9](UseResources[pool=p resources=A keep=true](b)))"
   " UseResources[pool=p resources=A](x)) resources[name=p]", "a=RS z=S b=RS x=R", "R[a] R[a z b] R[b] R[x]"},
  {"two in a row: not one after the other in a Fallback",
   "Parallel(Fallback[memory=true](UseResources[pool=p resources=A keep=true](a) UseResources[pool=p resources=A keep=true](b))"
   " UseResources[pool=p resources=A](x)) resources[name=p]", "a=RF b=R x=RS", "R[a] R[a] R[x]"},
  {"nested: an inner member asks for more while the outer one keeps its own",
   "Parallel(UseResources[pool=p resources=B keep=true](Sequence[memory=true](UseResources[pool=p resources=A keep=true](a)"
   " UseResources[pool=p resources=C keep=true](b))) UseResources[pool=p resources=B](x)) resources[name=p]",
   "a=RS b=RS x=R", "R[a] R[a b] R[b] R[x]"},
  {"nested: what the outer one owns is no obstacle",
   "UseResources[pool=p resources=A;B](UseResources[pool=p resources=B](a)) resources[name=p]", "a=RRS", "R[a] R[a] S[a]"},
  {"nested: what an inner one keeps is no obstacle to the outer one",
   "UseResources[pool=p resources=A](UseResources[pool=p resources=A;B keep=true](a)) resources[name=p]", "a=RRS", "R[a] R[a] S[a]"},
  {"nested: two inner ones do not own the same",
   "UseResources[pool=p resources=A keep=true](Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)))"
   " resources[name=p increment=0]", "a=RS b=R", "R[a] R[a] R[b]"},
  {"nested: without keep, the more urgent one gets both, as its outer one asks early for it",
   "Parallel(UseResources[pool=p resources=B](UseResources[pool=p resources=A](a)) UseResources[pool=p resources=A](UseResources[pool=p resources=B](b)))"
   " resources[name=p]", "a=R b=R", "R[a] R[] pause[a] R[a] resume[a] R[b] pause[a] R[a] resume[a] pause[b]"},
};

constexpr TickRow kHeldExchangeRows[] = {
  {"exchange: held in the tick in which it gets the new set, it keeps the old one until a tick reaches it",
   "Sequence[memory=true](Script[code=r:='A'] Parallel(ParallelAbsolute[barriers=.5](UseResources[pool=p resources={r} on_change=exchange]"
   "(Sequence[memory=true](a[on_success=r='B'] b)) s) UseResources[pool=p resources=A](x))) resources[name=p resources=A;B]",
   "a=S b=R s=R.1R.2R.6 x=R", "R[a b s] R[s] pause[b] R[s] R[b s] resume[b] R[b s x]"},
};

constexpr TickRow kChoiceRows[] = {
  {"any: the first that is free, in the written order",
   "Parallel(UseResources[pool=p resources=B](a) UseResources[pool=p resources=any(B;A)](b) UseResources[pool=p resources=any(B;A)](c)) resources[name=p increment=0]",
   "a=RS b=RRS c=R", "R[a b] R[a b] R[b c]"},
  {"any: without keep it prefers what it had",
   "Parallel(UseResources[pool=p resources=A](z) UseResources[pool=p resources=any(A;B)](a) Sequence[memory=true](x UseResources[pool=p resources=A](b)))"
   " resources[name=p increment=0]",
   "z=RS a=R x=RRS b=R", "R[z a x] R[z a x] R[a x b]"},
  {"any: beside others, all of which it needs",
   "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A;any(B;C)](b) UseResources[pool=p resources=B keep=true](c)) resources[name=p increment=0]",
   "a=RS b=R c=R", "R[a c] R[a c] R[b c]"},
  {"any: with an increment, a request of several waits as one",
   "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=B](b) UseResources[pool=p resources=any(A;B)](c)) resources[name=p]",
   "a=R b=R c=R", "R[a b] R{pause a, tick b, start c, tick c} R[a b] resume[a] pause[c]"},
};
// clang-format on

std::string who_owns(ScriptedRun& run) {
  std::string who;
  for (const LeafNode& leaf : run.tree().leaves) {
    const bool runs = run.ticker().status(leaf.node) == Status::Running;
    const char digit = static_cast<char>('1' + who.size());
    who += run.ticker().ticked(leaf.node) ? digit : runs ? '-' : '.';
  }
  return who;
}

// Of each member: '+' it owns, '-' it waits, '.' neither.
std::string claims(ScriptedRun& run) {
  std::string claims;
  for_each_resource_user(run.tree(), [&](NodeIndex member) {
    const double claim = limit(run.ticker(), member);
    claims += owns(claim) ? '+' : waits(claim) ? '-' : '.';
  });
  return claims;
}

struct ClaimRow {
  std::string_view law, tree, leaves, claims;
};

// clang-format off
constexpr ClaimRow kClaimRows[] = {
  {"a member owns or waits while it is ticked, and neither before and after",
   "Parallel(UseResources[pool=p resources=A](a) Sequence[memory=true](x UseResources[pool=p resources=A](b))) resources[name=p increment=0]",
   "a=RRRS x=RS b=RRR", "+. +- +- +- .+"},
  {"neither: a barrier holds it",
   "Parallel(SyncProgress[barrier=g](UseResources[pool=p resources=A](a)) SyncProgress[barrier=g](UseResources[pool=p resources=B](b)))"
   " barrier[name=g barriers=.5] resources[name=p]",
   "a=R.5 b=R.2R.5R.6", "++ .+ ++"},
  {"neither: it is inside of a member that waits",
   "Parallel(UseResources[pool=q resources=Z](UseResources[pool=p resources=A](a)) UseResources[pool=q resources=Z](b)) resources[name=p] resources[name=q]",
   "a=R b=R", "++- .-+ ++-"},
  {"neither: it was halted",
   "Parallel[success_count=1 failure_count=2](Sequence(g? UseResources[pool=p resources=A](a)) x) resources[name=p]",
   "g=SF a=R x=R", "+ + ."},
  {"neither: its child is skipped",
   "Sequence[memory=true](Script[code=y:=1] Parallel(UseResources[pool=p resources=A](a[skip_if=y==1]) UseResources[pool=p resources=A](b))) resources[name=p]",
   "a=R b=R", ".+ -+"},
};
// clang-format on

}  // namespace

TEST_CASE("UseResources: exchange") {
  for (TickRow row : kExchangeRows) {
    std::string tree(kExchange);
    tree.replace(tree.find('%'), 1, row.tree);
    row.tree = tree;
    check_rows(std::span(&row, 1));
  }
  check_rows(kHeldExchangeRows);
}

TEST_CASE("UseResources: two in a row, and nested ones of one pool") {
  check_rows(kHandoverRows);
}

TEST_CASE("UseResources: any of several") {
  check_rows(kChoiceRows);
}

TEST_CASE("UseResources: 'granted' has the names that a member owns, before its child is ticked") {
  ScriptedRun run(
      "Parallel(UseResources[pool=p resources=C](x) UseResources[pool=p resources={r} "
      "granted={which} on_change=exchange]"
      "(Sequence(Check[code=which=='B'||which=='A;B'] a))) resources[name=p resources=A;B;C]",
      "x=RRRR a=R");
  const auto which = [&] { return run.text_of("which"); };
  run.set("r", std::string("any(C;B)"));
  CHECK(run.tick(Nanoseconds(0)) == Status::Running);
  CHECK(which() == "B");
  run.set("r", std::string("any(A;C);B"));
  CHECK(run.tick(Nanoseconds(0)) == Status::Running);
  CHECK(which() == "A;B");
}

TEST_CASE("UseResources: the limit of a member that exchanges has both sets") {
  const double limit = limit_of_waiting(0b110, 0b011);
  CHECK(waits(limit));
  CHECK(resource_set(limit) == 0b110);
  CHECK(owned_set(limit) == 0b011);
  CHECK(owned_set(limit_of_waiting(0b110, 0)) == 0);
  CHECK(owned_set(5.0) == 5);
  CHECK(resource_set(-5.0) == 5);
  const ResourceSet most = (ResourceSet{1} << kMaxExchanged) - 1;
  CHECK(resource_set(limit_of_waiting(most, most)) == most);
  CHECK(owned_set(limit_of_waiting(most, most)) == most);
}

TEST_CASE("UseResources: what a member owns or waits for in a tick") {
  for (const ClaimRow& row : kClaimRows) {
    INFO(row.law << ": " << row.tree);
    ScriptedRun run(row.tree, row.leaves);
    std::string told;
    while (told.size() < row.claims.size()) {
      run.tick(Nanoseconds(0));
      told += (told.empty() ? "" : " ") + claims(run);
    }
    CHECK(told == row.claims);
  }
}

TEST_CASE("UseResources: a held SyncProgress inside is seen at its barrier") {
  ScriptedRun run(
      "Parallel(UseResources[pool=p resources=A](SyncProgress[barrier=g](a)) "
      "SyncProgress[barrier=g](b))"
      " barrier[name=g barriers=.5] resources[name=p]",
      "a=R.6 b=R.1RS");
  run.tick(Nanoseconds(0));
  run.tick(Nanoseconds(0));
  CHECK(run.ticker().held(3));
  CHECK(run.ticker().ticked(2));  // the SyncProgress
  run.tick(Nanoseconds(0));       // b succeeds
  run.tick(Nanoseconds(0));
  CHECK(run.ticker().ticked(run.tree().groups[0].node));
}

TEST_CASE("UseResources: only a member that waits gains priority") {
  ScriptedRun run(
      "Parallel(UseResources[pool=p resources=A](SyncProgress[barrier=g](a))"
      " SyncProgress[barrier=g](x)) barrier[name=g barriers=.5] resources[name=p increment=5]",
      "a=R.7... x=R.1...");
  for (int tick = 0; tick < 10; ++tick) run.tick(Nanoseconds(0));
  CHECK(run.ticker().state<ResourceUse>(run.tree().members[2].node).priority == 0);
}

TEST_CASE("UseResources: worked traces") {
  for (const ResourceTrace& trace : kResourceTraces) {
    INFO(trace.tree << ", " << trace.leaves);
    ScriptedRun run(trace.tree, trace.leaves);
    const auto ticks = std::ranges::count(trace.who, ' ') + 1;
    std::string who;
    Status status = Status::Running;
    for (int tick = 0; tick < ticks && status == Status::Running; ++tick) {
      status = run.tick(tick * std::chrono::milliseconds(100));
      who += (tick == 0 ? "" : " ") + who_owns(run);
    }
    CHECK(who == trace.who);
    CHECK(status == Status::Success);
  }
}

TEST_CASE("UseResources: resources from an entry are read in each tick") {
  ScriptedRun run(
      "Parallel(UseResources[pool=p resources={set}](a) UseResources[pool=p resources=A](b)"
      " UseResources[pool=p resources=B](c)) resources[name=p increment=0]",
      "a=R b=R c=R");
  const auto who_with = [&](const char* set) {
    run.set("set", std::string(set));
    run.tick(Nanoseconds(0));
    return who_owns(run);
  };
  CHECK(who_with("A") == "1.3");
  CHECK(who_with("B") == "12-");
  CHECK(who_with("B, A") == "1--");
  who_with("A;D");
  const Fault* fault = run.ticker().fault();
  REQUIRE(fault != nullptr);
  CHECK(run.tree().path(fault->node) == "Test/Parallel/UseResources");
  CHECK(fault->message ==
        "the pool 'p' has no resource 'D': 'resources' is 'A;D', from the entry '{set}'; its "
        "resources: 'A', 'B'");
}

TEST_CASE("UseResources: an entry without a resource, or without a value, is a fault") {
  const std::string tree =
      "Parallel(UseResources[pool=p resources={set}](a) UseResources[pool=p resources=A](b))"
      " resources[name=p]";
  ScriptedRun empty(tree, "a=R b=R");
  empty.set("set", std::string());
  empty.tick(Nanoseconds(0));
  REQUIRE(empty.ticker().fault() != nullptr);
  CHECK_THAT(empty.ticker().fault()->message, Catch::StartsWith("'resources' names nothing"));
  ScriptedRun unwritten(tree, "a=R b=R");
  unwritten.tick(Nanoseconds(0));
  REQUIRE(unwritten.ticker().fault() != nullptr);
  CHECK_THAT(unwritten.ticker().fault()->message, Catch::StartsWith("'resources' has no value"));
}

TEST_CASE("UseResources: with --on-fault fail a wrong entry fails the node, and frees the others") {
  ScriptedRun run(
      "Parallel[success_count=1 failure_count=2](UseResources[pool=p resources={set}](a)"
      " UseResources[pool=p resources=A](b)) resources[name=p increment=0]",
      "a=R b=R", FaultPolicy::Fail);
  run.set("set", std::string("A"));
  run.tick(Nanoseconds(0));
  CHECK(who_owns(run) == "1.");
  run.set("set", std::string("D"));
  run.tick(Nanoseconds(0));
  CHECK(who_owns(run) == ".2");
  CHECK(run.ticker().status(1) == Status::Failure);
  CHECK(run.ticker().tolerated().size() == 1);
}

TEST_CASE("UseResources: a member inside of one with a wrong entry does not own in that tick") {
  ScriptedRun run(
      "Parallel[success_count=1 failure_count=2](UseResources[pool=q resources={set}]("
      "UseResources[pool=p resources=A](a)) UseResources[pool=p resources=A](b))"
      " resources[name=p increment=0] resources[name=q resources=Z]",
      "a=R b=R", FaultPolicy::Fail);
  run.set("set", std::string("Z"));
  run.tick(Nanoseconds(0));
  CHECK(who_owns(run) == "1.");
  run.set("set", std::string("D"));
  run.tick(Nanoseconds(0));
  CHECK(who_owns(run) == ".2");
}

TEST_CASE("UseResources") {
  check_rows(kResourceRows);
}

TEST_CASE("UseResources: what a child keeps does not depend on what its entry says meanwhile") {
  ScriptedRun run(
      "Parallel(UseResources[pool=p resources={set} keep=true](a) UseResources[pool=p "
      "resources=A](b)"
      " UseResources[pool=p resources=B](c)) resources[name=p]",
      "a=RRS b=RRRR c=RRRR");
  const auto who_with = [&](const char* set) {
    run.set("set", std::string(set));
    run.tick(Nanoseconds(0));
    CHECK(run.ticker().fault() == nullptr);
    return who_owns(run);
  };
  CHECK(who_with("A") == "1.3");
  CHECK(who_with("B") == "1.3");
  CHECK(who_with("nothing that the pool has") == "1.3");
  CHECK(who_with("nothing that the pool has") == ".23");
}

TEST_CASE("UseResources: a priority rises to twice what all members can wait") {
  ScriptedRun run(
      "Parallel(UseResources[pool=p resources=A keep=true](a) UseResources[pool=p resources=A](b))"
      " resources[name=p increment=5]",
      "a=R... b=R...");
  for (int tick = 0; tick < 10; ++tick) run.tick(Nanoseconds(0));
  const NodeIndex waits = run.tree().members[1].node;
  CHECK(run.ticker().state<ResourceUse>(waits).priority == 2 * 2 * 5);
}

TEST_CASE("UseResources: a run that its owner has paused goes on") {
  ScriptedRun run(
      "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)) "
      "resources[name=p]",
      "a=RRR b=RRR");
  run.tick(Nanoseconds(0));
  CHECK(who_owns(run) == "1.");
  run.ticker().pause(0);
  run.tick(Nanoseconds(0));
  CHECK(who_owns(run) == "-2");
}

}  // namespace lockstep::host::test
