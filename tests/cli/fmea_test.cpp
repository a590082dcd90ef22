// `verify --fmea`: each row was found by hand first.
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// Grasp has two seconds; if it is not done then, the arm retreats.
const std::string kGrasp =
    "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Sequence memory=\"true\">"
    "<Fallback memory=\"true\"><Timeout seconds=\"2\"><Grasp/></Timeout><Retreat/></Fallback>"
    "<Parallel><Lift/><Watch/></Parallel></Sequence></BehaviorTree></root>\n";

}  // namespace

TEST_CASE("the table of failures says what the tree does when a leaf fails in each way") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("grasp.xml", kGrasp);
  const Outcome outcome = run_lockstep({"verify", tree, "--mock", "--fmea", "--format", "csv"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  const std::string head = "Leaf,Failure,Tree,Handled by,Halted,Not tried,Property violated\n";
  CHECK(outcome.out.starts_with(head));
  const std::string at = "Main/Sequence/", retreat = at + "Fallback/Retreat",
                    lift = at + "Parallel/Lift", watch = at + "Parallel/Watch",
                    grasp = at + "Fallback/Timeout/Grasp";
  const std::string rows[] = {
      grasp + ",fails at once,success (from 0.1 s)," + at + "Fallback,,,\n",
      grasp + ",never ends,success (from 2.1 s)," + at + "Fallback," + grasp + ",,\n",
      grasp + ",fault,ends with a fault,,," + retreat + "; " + lift + "; " + watch + ",\n",
      grasp + ",5 s late,success (from 2.1 s)," + at + "Fallback," + grasp + ",,\n",
      lift + ",fails at once,failure (from 0.1 s),,",
      lift + ",never ends,may not end,,",
  };
  for (const std::string& row : rows) {
    INFO(row << "\nin\n" << outcome.out);
    CHECK(contains(outcome.out, row));
  }
}

TEST_CASE("the table of failures has properties, and pairs on request") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("grasp.xml", kGrasp);
  const std::vector<std::string> call{
      "verify",   tree,   "--mock",     "--fmea",
      "--format", "json", "--property", "safe: never Retreat.failure"};
  const auto singles = parse_json(run_lockstep(call).out);
  std::size_t violated = 0;
  for (const auto& row : singles) {
    CHECK(row["failures"].size() == 1);
    violated += row["violated"].size();
  }
  CHECK(violated > 0);
  std::vector<std::string> more = call;
  more.emplace_back("--pairs");
  const auto pairs = parse_json(run_lockstep(more).out);
  const std::size_t n = singles.size() / 4;  // of each leaf
  CHECK(pairs.size() == singles.size() + 6 * n * n);
}

TEST_CASE("a table of failures has its own formats") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("grasp.xml", kGrasp);
  CHECK(run_lockstep({"verify", tree, "--mock", "--format", "csv"}).code == 2);
  CHECK(run_lockstep({"verify", tree, "--mock", "--fmea", "--format", "junit"}).code == 2);
  CHECK(run_lockstep({"verify", tree, "--mock", "--pairs"}).code == 2);
  const std::string table = run_lockstep({"verify", tree, "--mock", "--fmea"}).out;
  CHECK(table.starts_with("| Leaf | Failure | Tree |"));
}
