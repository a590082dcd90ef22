// What Groot2 sees of a run, from outside.
#include <catch2/catch.hpp>

#include "groot/groot_run.h"

using namespace lockstep::test;
using nlohmann::json;

namespace {

const std::string kPull = tree_text(
    "<Sequence name=\"all\" memory=\"true\"><Wait name=\"rest\" seconds=\"{pause}\"/>"
    "<ParallelAbsolute name=\"pull\" barriers=\"0.5\"><Advance name=\"arm\" step=\"0.1\"/>"
    "<Advance name=\"base\" step=\"0.25\"/></ParallelAbsolute></Sequence>");
const std::vector<std::string> kPause{"--set", "pause=0.02"};

constexpr int kIdle = 0, kRunning = 1, kSuccess = 2, kWas = 10;

json statuses(std::vector<int> each) {
  json list = json::array();
  for (std::size_t node = 0; node < each.size(); ++node) list.push_back({node + 1, each[node]});
  return list;
}

}  // namespace

TEST_CASE("the tree is a document for BehaviorTree.CPP, and its statuses those of the last tick") {
  GrootRun it(kPull, kPause);
  const std::string document = it.ask("T")["value"];
  const std::string tree =
      "<root BTCPP_format=\"4\">\n"
      "<BehaviorTree ID=\"Main\" _fullpath=\"\">\n"
      "<Sequence name=\"all\" _uid=\"1\">\n"
      "<Sleep name=\"rest\" _uid=\"2\" seconds=\"{pause}\"/>\n"
      "<ParallelAbsolute name=\"pull\" _uid=\"3\" barriers=\"0.5\">\n"
      "<Advance name=\"arm\" _uid=\"4\" step=\"0.1\"/>\n"
      "<Advance name=\"base\" _uid=\"5\" step=\"0.25\"/>\n"
      "</ParallelAbsolute>\n</Sequence>\n</BehaviorTree>\n";
  CHECK(document.substr(0, tree.size()) == tree);
  CHECK(contains(document, "<Control ID=\"ParallelAbsolute\">"));
  CHECK(contains(document, "<Action ID=\"Advance\">"));

  CHECK(it.ask("S")["value"] == statuses({kIdle, kIdle, kIdle, kIdle, kIdle}));
  it.step(1);
  CHECK(it.ask("S")["value"] == statuses({kRunning, kRunning, kIdle, kIdle, kIdle}));
  it.step(2);
  CHECK(it.ask("S")["value"] == statuses({kRunning, kSuccess, kRunning, kRunning, kRunning}));
  CHECK(it.resume().code == 0);
}

TEST_CASE("each answer repeats its request, and the tree has another name in each run") {
  GrootRun it(kPull, kPause);
  const auto answers = it.ask({"T", "S", "S"});
  for (const json& answer : answers) {
    CHECK(answer["repeats"] == true);
    CHECK(answer["tree"] == answers[0]["tree"]);
  }
  GrootRun other(kPull, kPause);
  CHECK(other.ask("S")["tree"] != answers[0]["tree"]);
}

TEST_CASE("progress and barriers are entries of the blackboard") {
  GrootRun it(kPull, kPause);
  it.step(5);
  it.wait_for("B:Main;Nobody", {{"Main",
                                 {{"pause", 0.02},
                                  {"barrier/all/pull", 0.5},
                                  {"progress/all/pull/arm", 0.2},
                                  {"progress/all/pull/base", 0.5},
                                  {"held/all/pull/arm", false},
                                  {"held/all/pull/base", true}}}});
  CHECK(it.ask("B:Nobody")["hex"] == "c0");
}

TEST_CASE("a client records the changes of statuses, with their times") {
  GrootRun it(kPull, kPause);
  it.step(1);
  const json began = it.ask("r:start");
  CHECK(std::stoull(began["value"].get<std::string>()) > 1'600'000'000'000'000);
  it.step(2);
  CHECK(it.ask("t")["value"] == json{{20'000, 2, kSuccess},
                                     {20'000, 3, kRunning},
                                     {20'000, 4, kRunning},
                                     {20'000, 5, kRunning}});
  CHECK(it.ask("r:stop")["parts"] == 1);
  it.step(1);
  CHECK(it.ask("t")["value"] == json::array());
}

TEST_CASE("what is no request gets an error, and the run goes on") {
  GrootRun it(kPull, kPause);
  const std::vector<std::string> wrong{
      "--raw",        "00",           "02540000000000",          "0253000000",
      "025100000000", "024200000000", "027200000000,7061757365", "00,00,00,00"};
  for (const json& answer : it.ask(wrong)) CHECK(answer.contains("error"));
  CHECK(it.ask("S")["value"].size() == 5);
  CHECK(it.resume().code == 0);
}

TEST_CASE("a port that is taken is an error before the run begins, also the one after it") {
  GrootRun it(kPull, kPause);
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", kPull);
  for (const unsigned port : {it.port(), it.port() - 1, it.port() + 1}) {
    const Outcome other = lockstep::test::lockstep({"run", tree, "--groot2", std::to_string(port)});
    CHECK(other.code == 2);
    CHECK(contains(other.err, "--groot2: cannot listen on '"));
    CHECK(other.out.empty());
  }
}
