// Breakpoints of Groot2, from outside.
#include <catch2/catch.hpp>

#include "groot/groot_run.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

const std::string kTree = tree_text(
    "<Sequence name=\"all\" memory=\"true\"><Wait name=\"first\" seconds=\"0.02\"/>"
    "<Wait name=\"second\" seconds=\"0.02\"/></Sequence>");

std::string hook(int uid, int mode = 0) {
  return json{{"enabled", true},
              {"uid", uid},
              {"mode", mode},
              {"once", false},
              {"desired_status", "SKIPPED"},
              {"position", 0}}
      .dump();
}
std::string key(int uid, const std::string& status = "SKIPPED") {
  return json{
      {"uid", uid}, {"position", 0}, {"desired_status", status}, {"remove_when_done", false}}
      .dump();
}

// Of the nodes 1 to 3.
json statuses(int all, int first, int second) {
  return {{1, all}, {2, first}, {3, second}};
}

}  // namespace

TEST_CASE("a breakpoint pauses the run after the tick, and says so to all who listen") {
  GrootRun it(kTree, {"--groot2-control"});
  CHECK(it.ask("I:" + hook(3))["parts"] == 1);
  CHECK(parse_json(it.ask("D")["value"].get<std::string>()).size() == 1);
  it.order({{"do", "resume"}});
  it.wait_for("S", statuses(1, 2, 1));
  CHECK(it.ask("U:" + key(3, "SUCCESS")).contains("error"));
  CHECK(it.ask("I:" + hook(3, 1)).contains("error"));
  CHECK(it.ask("S")["value"] == statuses(1, 2, 1));
  CHECK(it.ask("U:" + key(3))["parts"] == 1);
  CHECK(it.process().finish().code == 0);
}

TEST_CASE("who listens hears of a breakpoint that is reached") {
  const std::string endless =
      tree_text("<Repeat><Sequence memory=\"true\"><Wait seconds=\"0.02\"/></Sequence></Repeat>");
  GrootRun it(endless, {"--groot2-control", "--max-ticks", "1000000000"});
  it.order({{"do", "resume"}});
  const auto answers = it.ask_all({"I:" + hook(2), "listen:" + key(2), "A"});
  CHECK(answers[1]["events"] == json{"024e00000000", "2"});
  CHECK(answers[2]["parts"] == 1);
  CHECK(it.process().end_by(SIGTERM).code == 143);
}

TEST_CASE("a client that says good-bye lets the run go on") {
  GrootRun it(kTree, {"--groot2-control"});
  it.ask("I:" + hook(3));
  it.order({{"do", "resume"}});
  it.wait_for("S", statuses(1, 2, 1));
  it.ask("A");
  CHECK(it.process().finish().code == 0);
}

TEST_CASE("without --groot2-control, breakpoints are refused") {
  GrootRun it(kTree);
  for (const json& answer : it.ask_all({"I:" + hook(3), "R:" + key(3), "U:" + key(3)})) {
    CHECK(answer["error"] == "this run can only be watched: start it with --groot2-control");
  }
  CHECK(it.ask("D")["value"] == "[]");
  for (const json& answer : it.ask_all({"A", "X"})) CHECK(answer["parts"] == 1);
  CHECK(it.resume().code == 0);
}

TEST_CASE("control without a place where Groot2 finds the run is an error") {
  const TemporaryDirectory directory;
  const Outcome outcome =
      run_lockstep({"run", directory.file("tree.xml", kTree), "--groot2-control"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "--groot2-control needs --groot2"));
}
