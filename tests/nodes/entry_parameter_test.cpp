// Parameters of built-in nodes that come from entries: they are read in each tick, and what a node
// cannot take is a fault of that node.
#include <catch2/catch.hpp>

#include "engine/synchronized.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

using List = std::vector<double>;

Nanoseconds at(double seconds) {
  return from_seconds(seconds);
}

std::string fault_of(ScriptedRun& run) {
  const Fault* fault = run.ticker().fault();
  return fault == nullptr ? "" : run.tree().path(fault->node) + ": " + fault->message;
}

// The fault of the first tick of a tree whose entry 'it' has this value.
std::string refused(std::string_view tree, std::string_view leaves, Value value) {
  ScriptedRun run(tree, leaves);
  run.set("it", std::move(value));
  run.tick(at(0));
  return fault_of(run);
}

bool is_held(ScriptedRun& run, NodeIndex node) {
  return run.ticker().held(node);
}

}  // namespace

TEST_CASE("entry parameter: delta and barriers change from tick to tick") {
  ScriptedRun relative("ParallelRelative[delta={delta}](a b)", "a=R.1... b=R.6...");
  relative.set("delta", 1.0);
  relative.tick(at(0));
  relative.tick(at(0.1));
  CHECK_FALSE(is_held(relative, 2));
  CHECK(limit(relative.ticker(), 0) == 1.0);
  relative.set("delta", 0.2);
  relative.tick(at(0.2));
  CHECK(is_held(relative, 2));
  CHECK(limit(relative.ticker(), 0) == 0.2);
  relative.set("delta", 0.5);
  relative.tick(at(0.3));
  CHECK_FALSE(is_held(relative, 2));

  ScriptedRun absolute("ParallelAbsolute[barriers={plan}](a b)", "a=R.1... b=R.6...");
  absolute.set("plan", List{0.7});
  absolute.tick(at(0));
  absolute.tick(at(0.1));
  CHECK_FALSE(is_held(absolute, 2));
  CHECK(limit(absolute.ticker(), 0) == 0.7);
  absolute.set("plan", List{0.2, 0.4, 0.7, 0.9});  // longer than before
  absolute.tick(at(0.2));
  CHECK(is_held(absolute, 2));
  CHECK(limit(absolute.ticker(), 0) == 0.2);
  absolute.set("plan", List{});
  absolute.tick(at(0.3));
  CHECK_FALSE(is_held(absolute, 2));
  CHECK(limit(absolute.ticker(), 0) == std::numeric_limits<double>::infinity());
  CHECK(fault_of(absolute).empty());
}

TEST_CASE("entry parameter: what follows from an entry follows again when it changes") {
  ScriptedRun run("ParallelAbsolute[barrier_count={n}](a b)", "a=R.1... b=R.6...");
  run.set("n", std::int64_t{4});
  run.tick(at(0));
  run.tick(at(0.1));
  CHECK(limit(run.ticker(), 0) == 0.25);
  run.set("n", std::int64_t{2});
  run.tick(at(0.2));
  CHECK(limit(run.ticker(), 0) == 0.5);
}

TEST_CASE("entry parameter: numbers and words of other nodes") {
  ScriptedRun wait("Wait[seconds={pause}]", "");
  wait.set("pause", 0.2);
  CHECK(wait.tick(at(0)) == Status::Running);
  wait.set("pause", 5.0);
  CHECK(wait.tick(at(0.3)) == Status::Running);
  wait.set("pause", 0.4);
  CHECK(wait.tick(at(0.4)) == Status::Success);

  ScriptedRun retry("Retry[attempts={n}](a)", "a=F...");
  retry.set("n", std::int64_t{2});
  CHECK(retry.tick(at(0)) == Status::Running);
  CHECK(retry.tick(at(0.1)) == Status::Failure);

  ScriptedRun word("ParallelAbsolute[barriers=.5 at_barrier={it}](a b)", "a=R.1... b=R.5...");
  word.set("it", std::string("tick"));
  word.tick(at(0));
  word.tick(at(0.1));
  CHECK_FALSE(is_held(word, 2));
  word.set("it", std::string("wait"));
  word.tick(at(0.2));
  CHECK(is_held(word, 2));
}

TEST_CASE("entry parameter: two nodes of one entry, and one of several") {
  ScriptedRun run("Parallel[success_count={m} failure_count={n}](a b Wait[seconds={m2}])",
                  "a=S b=F");
  run.set("m", std::int64_t{1});
  run.set("n", std::int64_t{3});
  run.set("m2", 1.0);
  CHECK(run.tick(at(0)) == Status::Success);
}

TEST_CASE("entry parameter: an entry that nobody wrote") {
  ScriptedRun by_default("ParallelAbsolute[barriers=.5 at_barrier={it}](a b)", "a=R.1... b=R.5...");
  by_default.tick(at(0));
  by_default.tick(at(0.1));
  CHECK(is_held(by_default, 2));  // wait

  ScriptedRun absent("Repeat[times={n}](a)", "a=S...");  // optional: for ever
  for (int i = 0; i < 5; ++i) CHECK(absent.tick(at(0.1 * i)) == Status::Running);

  ScriptedRun missing("Sequence(Wait[seconds={pause}])", "");
  missing.tick(at(0));
  CHECK(fault_of(missing) ==
        "Test/Sequence/Wait: 'seconds' has no value: nothing has written the entry '{pause}'");
}

TEST_CASE("entry parameter: a value that the node cannot take is a fault that says all") {
  CHECK(refused("ParallelRelative[delta={it}](a b)", "a=R b=R", 1.5) ==
        "Test/ParallelRelative: 1.5 is outside the range of 'delta': 'delta' is '1.5', from the "
        "entry '{it}'; it must be from 0 to 1");
  CHECK(
      refused("ParallelAbsolute[barriers={it}](a b)", "a=R b=R", List{0.5, 0.2}) ==
      "Test/ParallelAbsolute: barriers must rise: 'barriers' is '0.5;0.2', from the entry '{it}'; "
      "write '0.2;0.5'");
  CHECK(refused("ParallelAbsolute[barriers={it}](a b)", "a=R b=R", List{0.5, 1.2}) ==
        "Test/ParallelAbsolute: 1.2 is outside the range of 'barriers': 'barriers' is '0.5;1.2', "
        "from the entry '{it}'; it must be from 0 to 1");
  CHECK(refused("Parallel[success_count={it}](a b)", "a=R b=R", std::int64_t{3}) ==
        "Test/Parallel: 'success_count' is more than the 2 children of the node: 'success_count' "
        "is '3', from the entry '{it}'; give at most 2");
  CHECK(refused("ParallelAbsolute[barriers=.5 at_barrier={it}](a b)", "a=R b=R",
                std::string("jump")) ==
        "Test/ParallelAbsolute: 'jump' is not a value of 'at_barrier': 'at_barrier' is 'jump', "
        "from the entry '{it}'; it must be one of 'wait', 'tick'");
}

TEST_CASE("entry parameter: a text or another number is converted to the parameter's type") {
  ScriptedRun run("Repeat[times={it}](a)", "a=S...");
  run.set("it", std::string("2x"));
  CHECK(run.tick(at(0)) == Status::Running);
  CHECK(run.tick(at(0.1)) == Status::Success);
  run.set("it", 1.0);
  CHECK(run.tick(at(0.2)) == Status::Success);
  CHECK(refused("Repeat[times={it}](a)", "a=S", std::string("two")) ==
        "Test/Repeat: expected a whole number: 'times' is 'two', from the entry '{it}'");
  CHECK(refused("Repeat[times={it}](a)", "a=S", 1.5) ==
        "Test/Repeat: expected a whole number: 'times' is '1.5', from the entry '{it}'");
}

TEST_CASE("entry parameter: a refused value is a Failure under the policy that goes on") {
  ScriptedRun run("Fallback(ParallelRelative[delta={it}](a b) c)", "a=R.1... b=R.2... c=S",
                  FaultPolicy::Fail);
  run.set("it", 0.5);
  CHECK(run.tick(at(0)) == Status::Running);
  run.set("it", -1.0);
  run.events.clear();
  CHECK(run.tick(at(0.1)) == Status::Success);
  CHECK(run.ticker().take_tolerated().size() == 1);
  CHECK(run.events.front() == Event{Call::Halt, 0});
  CHECK(run.events[1] == Event{Call::Halt, 1});
}

TEST_CASE("entry parameter: a run that begins again knows nothing of the last one") {
  ScriptedRun run("Wait[seconds={pause}]", "");
  run.set("pause", 0.1);
  CHECK(run.tick(at(0)) == Status::Running);
  run.restart();
  run.tick(at(0));
  CHECK(fault_of(run).starts_with("Test/Wait: 'seconds' has no value"));
}

}  // namespace lockstep::host::test
