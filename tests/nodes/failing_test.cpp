// A running node whose next tick its owner makes a Failure.
#include <catch2/catch.hpp>
#include <string>

#include "nodes/control_nodes.h"
#include "support/plugin_nodes.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

const KnownPlugin kFailingKnown(kControlNodes);

struct FailingRow {
  std::string_view law, tree, leaves;
  NodeIndex node;
  std::string_view expected;  // the second tick: status, what leaves are told, '!' if it has failed
  FaultPolicy policy = FaultPolicy::Stop;
};

// clang-format off
constexpr FailingRow kFailingRows[] = {
  {"it is halted, in the order of the tree, and fails",
   "Fallback(ParallelAbsolute[barriers=.5](a Sequence(b) c) d)", "a=R b=R.7 c=R d=R",
   1, "R halt a, halt b, halt c, start d, tick d!"},
  {"a control node of any kind",
   "Fallback(Sequence(a) b)", "a=R b=S", 1, "S halt a, start b, tick b!"},
  {"a decorator", "Inverter(Timeout[seconds=9](a))", "a=R", 1, "S halt a!"},
  {"the root", "Parallel(a b)", "a=R b=S", 0, "F halt a!"},
  {"what has completed in it is not told",
   "Parallel(a b)", "a=S b=R", 0, "F halt b!"},
  {"a Retry starts it again in the next tick",
   "Retry[attempts=2](Parallel(a b))", "a=R b=R", 1, "R halt a, halt b!"},
  {"a leaf", "Fallback(a b)", "a=R b=S", 1, "S halt a, start b, tick b!"},
  {"a node of a plugin halts its children in its own way",
   "Fallback(First(a b) c)", "a=R b=R c=S", 1, "S halt a, halt b, start c, tick c!"},
  {"not in a tick that does not reach it",
   "Sequence(g? Parallel(a))", "g=SF a=R", 2, "F start g, tick g, halt a"},
  {"not if it is held",
   "ParallelAbsolute[barriers=.5](a Parallel(b))", "a=R.1 b=R.7", 2, "R tick a, pause b"},
  {"not if it does not run", "Sequence[memory=true](a Parallel(b))", "a=RS b=R", 2,
   "R tick a, start b, tick b"},
  {"a leaf that cannot be halted is at fault, and the run ends",
   "Fallback(Parallel(a b) c)", "a=R!halt b=R c=S", 1, "R halt a!"},
  {"with --on-fault fail, it fails all the same",
   "Fallback(Parallel(a b) c)", "a=R!halt b=R c=S", 1, "S halt a, halt b, start c, tick c!",
   FaultPolicy::Fail},
};
// clang-format on

std::string told(ScriptedRun& run) {
  std::string text;
  for (const Event& event : run.events) {
    text += text.empty() ? " " : ", ";
    text += std::string(to_string(event.call)) + " " + run.leaf_name(event.leaf);
  }
  run.events.clear();
  return text;
}

std::string second_tick(const FailingRow& row) {
  ScriptedRun run(row.tree, row.leaves, row.policy);
  run.tick_root(Nanoseconds(0));
  run.events.clear();
  run.ticker().fail_next(row.node);
  const Status status = run.tick_root(std::chrono::milliseconds(100));
  std::string text(1, status_letters()[static_cast<std::size_t>(status)]);
  text += told(run);
  if (run.ticker().take_failed(row.node)) text += '!';
  return text;
}

}  // namespace

TEST_CASE("a node that its owner makes fail") {
  for (const FailingRow& row : kFailingRows) {
    INFO(row.law << "\n  " << row.tree);
    CHECK(second_tick(row) == row.expected);
  }
}

TEST_CASE(
    "a node that was made to fail begins again like any other, and is not made to fail again") {
  ScriptedRun run("Retry[attempts=9](ParallelAbsolute[barriers=.5](a b))", "a=R.2 b=R.7");
  Ticker& ticker = run.ticker();
  for (int tick = 0; tick < 5; ++tick) {
    if (tick == 2) ticker.fail_next(1);
    CHECK(run.tick_root(tick * std::chrono::milliseconds(100)) == Status::Running);
    if (tick == 2) CHECK(ticker.take_failed(1));
    CHECK(ticker.status(1) == (tick == 2 ? Status::Failure : Status::Running));
    CHECK(ticker.status(2) == (tick == 2 ? Status::Idle : Status::Running));
  }
  CHECK(told(run) ==
        " start a, tick a, start b, tick b, tick a, pause b, halt a, halt b, start a, tick a, "
        "start b, tick b, tick a, pause b");
}

TEST_CASE("a leaf whose halt is a fault is not halted again at the end of the run") {
  ScriptedRun leaf("Fallback(a b)", "a=R!halt b=S");
  leaf.tick(Nanoseconds(0));
  leaf.events.clear();
  leaf.ticker().fail_next(1);
  CHECK(leaf.tick(std::chrono::milliseconds(100)) == Status::Running);
  CHECK(leaf.ticker().faulted());
  CHECK(told(leaf) == " halt a");
}

TEST_CASE("a node that halts its children itself, and is at fault in that, is halted once") {
  ScriptedRun run("Sequence(c? HaltsFirst(a b))", "c=SF a=R b=R");
  std::string seen;
  watching_seen = [&](const char* function) { seen += std::string(function) + ";"; };
  run.tick(Nanoseconds(0));
  run.events.clear();
  run.tick(std::chrono::milliseconds(100));
  CHECK(run.ticker().faulted());
  CHECK(seen == "halt;");
  CHECK(told(run) == " start c, tick c, halt a, halt b");
}

TEST_CASE("a node whose child is at fault in a halt by a script is halted after it") {
  ScriptedRun run(
      "Sequence[memory=true](Script[code=n:=0] Parallel(Watching[while=n<1](a) "
      "b[on_success=n:=1] c))",
      "a=R!halt b=S c=R");
  std::string seen;
  watching_seen = [&](const char* function) { seen += std::string(function) + ";"; };
  for (int tick = 0; tick < 3; ++tick) run.tick(tick * std::chrono::milliseconds(100));
  CHECK(run.ticker().faulted());
  CHECK(seen == "halt;");
}

TEST_CASE("the script of a halt runs once, also where the halt meets a fault") {
  ScriptedRun run(
      "Sequence[memory=true](Script[code=n:=0] Script[code=m:=0] Script[code=k:=0] "
      "Sequence(c? Parallel(d[on_halt=k+=10] Sequence[on_halt=n+=1](Inverter[on_halt=m+=1]("
      "a[on_halt=k+=1])))))",
      "c=SF a=R!halt d=R");
  run.tick(Nanoseconds(0));
  run.tick(std::chrono::milliseconds(100));
  CHECK(run.ticker().faulted());
  CHECK(run.text_of("n") == "1");
  CHECK(run.text_of("m") == "1");
  CHECK(run.text_of("k") == "11");
}

TEST_CASE("a fault of the script of a halt leaves no sibling running") {
  ScriptedRun run(
      "Sequence[memory=true](Script[code=y:=0] Script[code=z:=0] Parallel(Parallel("
      "Sequence[on_halt=z:=1/y](a) Sequence[on_halt=z+=7](b)) c))",
      "a=R b=R c=RF");
  run.tick(Nanoseconds(0));
  run.events.clear();
  run.tick(std::chrono::milliseconds(100));
  CHECK(run.ticker().faulted());
  CHECK(told(run) == " tick a, tick b, tick c, halt a, halt b");
  CHECK(run.text_of("z") == "7");
}

TEST_CASE("a leaf that has completed is not halted after a fault of a script around it") {
  ScriptedRun run(
      "Sequence[memory=true](Script[code=n:=0] Sequence(a[skip_if=n] Script[code=n:=2] b))",
      "a=S b=R");
  CHECK(run.tick(Nanoseconds(0)) == Status::Running);
  run.events.clear();
  CHECK(run.tick(std::chrono::milliseconds(100)) == Status::Running);
  CHECK(run.ticker().faulted());
  CHECK(told(run) == " halt b");
}

TEST_CASE("an order that no tick reached is over when it was taken back") {
  ScriptedRun run("ParallelAbsolute[barriers=.5](a Parallel(b))", "a=R.1R.1R.9 b=R.7");
  run.tick_root(Nanoseconds(0));
  run.ticker().fail_next(2);
  run.tick_root(std::chrono::milliseconds(100));
  CHECK_FALSE(run.ticker().take_failed(2));
  for (int tick = 2; tick < 6; ++tick) run.tick_root(tick * std::chrono::milliseconds(100));
  CHECK(run.ticker().status(2) == Status::Running);
}

TEST_CASE("several nodes may be made to fail in one tick") {
  ScriptedRun run("Parallel[success_count=1 failure_count=3](Sequence(a) Sequence(b) c)",
                  "a=R b=R c=R");
  run.tick_root(Nanoseconds(0));
  for (const NodeIndex node : {1u, 3u}) run.ticker().fail_next(node);
  run.tick_root(std::chrono::milliseconds(100));
  for (const NodeIndex node : {1u, 3u}) {
    CHECK(run.ticker().take_failed(node));
    CHECK(run.ticker().status(node) == Status::Failure);
  }
  CHECK(run.ticker().status(5) == Status::Running);
}

TEST_CASE("the scripts after a failure run, and those of a halt in what it contained") {
  ScriptedRun run(
      "Sequence[memory=true](Script[code=n:=0] ForceSuccess(Parallel[on_failure=n+=1 on_halt=n+=10 "
      "on_end=n+=100](a[on_halt=n+=1000])) Check[code=n==1101] b)",
      "a=R b=S");
  run.tick_root(Nanoseconds(0));
  run.ticker().fail_next(3);
  CHECK(run.tick_root(std::chrono::milliseconds(100)) == Status::Success);
}

TEST_CASE("a barrier begins again with the node that all of its members are below") {
  ScriptedRun run(
      "Retry[attempts=9](Parallel(SyncProgress[barrier=b](x) SyncProgress[barrier=b](y))) "
      "barrier[name=b barriers=.5]",
      "x=R.6 y=R.2");
  run.tick_root(Nanoseconds(0));
  run.tick_root(std::chrono::milliseconds(100));
  REQUIRE(run.ticker().held(3));
  run.ticker().fail_next(1);
  run.tick_root(std::chrono::milliseconds(200));
  CHECK(run.ticker().take_failed(1));
  run.events.clear();
  run.tick_root(std::chrono::milliseconds(300));
  CHECK(told(run) == " start x, tick x, start y, tick y");
}

}  // namespace lockstep::host::test
