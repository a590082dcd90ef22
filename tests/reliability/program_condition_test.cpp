// Conditions of programs on both clocks: an action behind one is not halted because its answer
// needs time.
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

struct ConditionRun {
  Outcome outcome;
  nlohmann::json summary;
};

ConditionRun run_with(const std::string& nodes, const std::string& clock,
                      std::vector<std::string> more = {}) {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml",
                     "<root lockstep=\"1\"><plugin name=\"conditions\" program=\"conditions.py\"/>"
                     "<plugin name=\"motion\"/><BehaviorTree ID=\"Main\">" +
                         nodes + "</BehaviorTree></root>");
  more.insert(more.begin(), {"run", tree, "--plugin-path", LOCKSTEP_SOURCE_DIR "/tests/programs",
                             "--clock", clock, "--json", "--view", "none"});
  if (std::ranges::find(more, "--max-ticks") == more.end()) {
    more.insert(more.end(), {"--max-ticks", "400"});
  }
  ConditionRun run{.outcome = run_lockstep(more), .summary = {}};
  run.summary = nlohmann::json::parse(run.outcome.out, nullptr, false);
  return run;
}

// A busy machine gets more time than a tick has by itself.
const std::vector<std::string> kPatient{"--condition-wait", "0.5", "--rate", "100"};

}  // namespace

TEST_CASE("behind conditions of programs, a tree takes as many ticks on the wall clock") {
  const char* const kTrees[] = {
      R"(<Sequence><IsUp/><Advance step="0.05"/></Sequence>)",
      R"(<Sequence><IsUp/><IsUp/><IsUp/><Advance step="0.05"/></Sequence>)",
      R"(<Fallback><IsUp answer="failure"/><Advance step="0.05"/></Fallback>)",
      R"(<Parallel><IsUp/><Advance step="0.05"/></Parallel>)",
      R"(<ParallelAbsolute barriers="0.5"><Sequence><IsUp/><Advance step="0.1"/></Sequence>)"
      R"(<Sequence><IsUp/><Advance step="0.04"/></Sequence></ParallelAbsolute>)",
  };
  for (const char* tree : kTrees) {
    const ConditionRun jumped = run_with(tree, "virtual");
    const ConditionRun waited = run_with(tree, "wall", kPatient);
    INFO(tree << '\n' << waited.outcome.err);
    CHECK(jumped.outcome.code == 0);
    CHECK(waited.outcome.code == 0);
    CHECK(waited.summary["ticks"] == jumped.summary["ticks"]);
  }
}

TEST_CASE("a condition that is slower than a tick may wait has its last result") {
  const std::string tree = R"(<Sequence><IsUp after="0.03"/><Advance step="0.05"/></Sequence>)";
  const ConditionRun run = run_with(tree, "wall", {"--rate", "100", "--condition-age", "5"});
  INFO(run.outcome.err);
  CHECK(run.outcome.code == 0);
  CHECK(contains(
      run.outcome.err,
      "Main/Sequence/IsUp: warning: the answer of this condition is late: it has no result yet"));
  // The first answer takes some ticks; after that the action is never halted.
  CHECK(run.summary["ticks"] < 300);
  CHECK(!contains(run.outcome.err, "was started and halted"));
}

TEST_CASE("a result that is too old counts no more: the condition is Running and is named") {
  const std::string tree = R"(<Sequence><IsUp stops_at="5"/><Advance step="0.000001"/></Sequence>)";
  const ConditionRun run =
      run_with(tree, "wall", {"--rate", "200", "--condition-wait", "0.3", "--max-ticks", "100"});
  INFO(run.outcome.err);
  CHECK(contains(run.outcome.err,
                 "its last result is older than 0.025 s, the limit of "
                 "--condition-age"));
}

TEST_CASE("a condition whose process has stopped for good is a fault after the hang limit") {
  const ConditionRun run =
      run_with(R"(<Sequence><IsUp stops_at="5"/><AlwaysRunning/></Sequence>)", "wall",
               {"--hang-limit", "1", "--halt-limit", "9", "--max-ticks", "100000"});
  INFO(run.outcome.err);
  CHECK(run.outcome.code == 5);
  CHECK(contains(run.outcome.err, "did not answer 'Main/Sequence/IsUp' for 1 s; it was killed"));
}

TEST_CASE("what a condition of a program does for verify has one tick") {
  const TemporaryDirectory directory;
  const std::string program = directory.file(
      "up.py",
      "#!/usr/bin/python3\nfrom lockstep_leaf import Condition, serve\nclass Up(Condition):\n"
      "    behavior = {'ticks': '2..4'}\n    def tick(self): return True\nserve()\n");
  chmod(program.c_str(), 0755);
  const Outcome outcome = run_lockstep({"plugin", "check", program});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 4);
  CHECK(contains(outcome.out, "the behavior of 'Up' has more than one tick"));
}

TEST_CASE("a condition of a program that answers running is a fault on both clocks") {
  for (const char* clock : {"wall", "virtual"}) {
    const ConditionRun run =
        run_with(R"(<Sequence><IsUp answer="running"/><Advance/></Sequence>)", clock, kPatient);
    INFO(run.outcome.err);
    CHECK(run.outcome.code == 5);
    CHECK(contains(run.outcome.err,
                   "is a condition and answered 'running', expected 'success' or 'failure'"));
  }
}

TEST_CASE("a tick waits for all of its conditions together as long as for one") {
  std::string nodes = "<Parallel>";
  for (int i = 0; i < 10; ++i) nodes += R"(<IsUp after="0.05"/>)";
  const ConditionRun run =
      run_with(nodes + R"(<AlwaysRunning/></Parallel>)", "wall",
               {"--rate", "10", "--condition-wait", "0.05", "--max-ticks", "3"});
  INFO(run.outcome.err);
  CHECK(run.summary["overruns"] == 0);
}
