// What Groot2 sees of a run, from outside.
#include <catch2/catch.hpp>

#include "groot/groot_run.h"

using namespace lockstep::host::test;
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
      "<Wait name=\"rest\" _uid=\"2\" seconds=\"{pause}\"/>\n"
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

TEST_CASE("each SubTree is a tree, with the names by which its nodes know entries") {
  GrootRun it(
      "<root lockstep=\"1\" main_tree_to_execute=\"Main\"><plugin name=\"motion\"/>"
      "<BehaviorTree ID=\"Main\"><Sequence memory=\"true\">"
      "<Script code=\"far := 2.5; who := 'me &amp; you'\"/>"
      "<SubTree ID=\"Go\" way=\"{far}\" on_success=\"done := true\"/>"
      "<SubTree ID=\"Go\" name=\"back\" way=\"7\"/>"
      "</Sequence></BehaviorTree>"
      "<BehaviorTree ID=\"Go\"><ParallelRelative name=\"go\" delta=\"0.2\">"
      "<Wait name=\"&lt;a&gt;\" seconds=\"{way}\"/><Wait name=\"b\" seconds=\"1\"/>"
      "</ParallelRelative></BehaviorTree></root>");
  const std::string document = it.ask("T")["value"];
  for (const std::string part :
       {"<BehaviorTree ID=\"Main\" _fullpath=\"\">\n<Sequence name=\"Sequence\" _uid=\"1\">\n"
        "<Script name=\"Script\" _uid=\"2\" code=\"far := 2.5; who := 'me &amp; you'\"/>\n"
        "<SubTree ID=\"Go\" _fullpath=\"Go::3\" _uid=\"3\" way=\"{far}\" "
        "_onSuccess=\"done := true\"/>\n"
        "<SubTree ID=\"Go\" _fullpath=\"back\" _uid=\"7\" way=\"7\"/>\n"
        "</Sequence>\n</BehaviorTree>\n"
        "<BehaviorTree ID=\"Go\" _fullpath=\"Go::3\">\n"
        "<ParallelRelative name=\"go\" _uid=\"4\" delta=\"0.2\">\n"
        "<Wait name=\"&lt;a&gt;\" _uid=\"5\" seconds=\"{way}\"/>\n"
        "<Sleep name=\"b\" _uid=\"6\" msec=\"1000\"/>\n",
        "<BehaviorTree ID=\"Go\" _fullpath=\"back\">\n"
        "<ParallelRelative name=\"go\" _uid=\"8\""}) {
    INFO(document);
    CHECK(contains(document, part));
  }
  std::vector<int> order;
  const json rows = it.ask("S")["value"];
  for (const json& row : rows) order.push_back(row[0]);
  CHECK(order == std::vector<int>{1, 2, 3, 7, 4, 5, 6, 8, 9, 10});
  it.step(2);
  const json main{{"far", 2.5}, {"who", "me & you"}};
  it.wait_for("B:Go::3;back", {{"ROOT", main},
                               {"Go::3",
                                {{"way", 2.5},
                                 {"delta/go", 0.2},
                                 {"progress/go/<a>", 0.004},
                                 {"progress/go/b", 0.01},
                                 {"held/go/<a>", false},
                                 {"held/go/b", false}}},
                               {"back",
                                {{"way", 7},
                                 {"delta/go", 0.0},
                                 {"progress/go/<a>", 0.0},
                                 {"progress/go/b", 0.0},
                                 {"held/go/<a>", false},
                                 {"held/go/b", false}}}});
}

TEST_CASE("a client that asks gets the statuses after the last tick") {
  GrootRun it(kPull, kPause);
  it.step(1);
  Process client({.arguments = {LOCKSTEP_SOURCE_DIR "/tests/groot/client.py",
                                std::to_string(it.port()), "S", "end"},
                  .program = "/usr/bin/python3"});
  REQUIRE(client.wait_for("}\n"));
  CHECK(it.resume().code == 0);
  const Outcome outcome = client.finish();
  INFO(outcome.err);
  CHECK(parse_json(lines(outcome.out).back())["value"] ==
        statuses({kSuccess, kSuccess, kSuccess, kSuccess, kSuccess}));
}

TEST_CASE("a run that ends by a fault ends as always") {
  GrootRun it(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence><Script code=\"y:='hi'\"/>"
      "<Sleep msec=\"20\"/><ScriptCondition code=\"y != 7\"/></Sequence></BehaviorTree></root>");
  it.step(1);
  CHECK(it.ask("B:Main")["value"] == json{{"Main", {{"y", "hi"}}}});
  CHECK(it.resume().code == 5);
}

TEST_CASE("a tree with more nodes than Groot2 can number is refused") {
  const TemporaryDirectory directory;
  const auto run_with = [&](int leaves) {
    std::string tree = "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Sequence>";
    for (int leaf = 0; leaf < leaves; ++leaf) tree += "<AlwaysSuccess/>";
    tree += "</Sequence></BehaviorTree></root>";
    return run_lockstep({"run", directory.file("tree.xml", tree), "--groot2", "0"});
  };
  CHECK(run_with(65'534).code == 0);
  const Outcome refused = run_with(65'535);
  CHECK(refused.code == 2);
  CHECK(contains(refused.err,
                 "--groot2: the tree has 65536 nodes, and Groot2 can number 65535 of them"));
}

TEST_CASE("a place that is none is an error") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", kPull);
  for (const auto& [value, said] :
       std::vector<std::pair<std::string, std::string>>{{"65535", "the largest is 65534"},
                                                        {"65536", "the largest port is 65535"},
                                                        {"127.0.0.1:x", "ADDRESS:PORT"},
                                                        {"192.0.2.1:0", "cannot listen on"}}) {
    const Outcome outcome = run_lockstep({"run", tree, "--groot2=" + value});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "--groot2: "));
    CHECK(contains(outcome.err, said));
  }
  CHECK(run_lockstep({"run", tree, "--groot"}).code == 2);
}

TEST_CASE("an address that other machines reach is warned of") {
  const TemporaryDirectory directory;
  const Outcome outcome = run_lockstep(
      {"run", directory.file("tree.xml", tree_text("<AlwaysSuccess/>")), "--groot2", "0.0.0.0:0"});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "can be reached from other machines"));
}

TEST_CASE("each answer repeats its request, and the tree has another name in each run") {
  GrootRun it(kPull, kPause);
  const auto answers = it.ask_all({"T", "S", "S"});
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
  for (const json& answer : it.ask_all(wrong)) CHECK(answer.contains("error"));
  CHECK(it.ask("S")["value"].size() == 5);
  CHECK(it.resume().code == 0);
}

TEST_CASE("a port that is taken is an error before the run begins, also the one after it") {
  GrootRun it(kPull, kPause);
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", kPull);
  for (const unsigned port : {it.port(), it.port() - 1, it.port() + 1}) {
    const Outcome other = run_lockstep({"run", tree, "--groot2", std::to_string(port)});
    CHECK(other.code == 2);
    CHECK(contains(other.err, "--groot2: cannot listen on '"));
    CHECK(other.out.empty());
  }
}
