// Trees for BehaviorTree.CPP on the command line: without their plugins, and with models.
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

std::string document(const std::string& node) {
  return "<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"Main tree\">\n" + node +
         "\n</BehaviorTree></root>\n";
}

const std::string kNodes =
    "<ParallelAbsolute barriers=\"0.5\"><Dock goal=\"{pose}\"/><Rate hz=\"2\"><Pick/></Rate>"
    "<Condition ID=\"IsOpen\"/></ParallelAbsolute>";

Outcome run_mocked(const std::string& tree, std::vector<std::string> more) {
  std::vector<std::string> arguments{"run",     tree,     "--mock", "--clock",
                                     "virtual", "--view", "none",   "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_lockstep(arguments);
}

}  // namespace

// In version 3, "place" in a SubTree named an entry. BehaviorTree.CPP 4 reads it as a text.
TEST_CASE("run reads a value of version 3 as version 4 does, and convert keeps what it meant") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("3.xml", R"(<root main_tree_to_execute="M">
<BehaviorTree ID="M"><Sequence><SetBlackboard output_key="place" value="dock"/>
<SubTree ID="Go" to="place"/></Sequence></BehaviorTree>
<BehaviorTree ID="Go"><ScriptCondition code="to == 'dock'"/></BehaviorTree></root>)");
  const auto result = [](const std::string& file) {
    return parse_json(run_mocked(file, {}).out)["result"].get<std::string>();
  };
  CHECK(result(tree) == "failure");
  CHECK(contains(run_lockstep({"check", tree}).err,
                 "3.xml:3:22: warning: 'place' is a text here; before version 4 it could be"));
  const Outcome four = run_lockstep({"convert", "--to", "btcpp4", tree});
  CHECK(contains(four.err, "3.xml:3:22: warning: 'place' is taken for an entry"));
  CHECK(result(directory.file("4.xml", four.out)) == "success");
}

TEST_CASE(
    "an entry that is removed and written again in a tick has its new value for all who watch") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="T"><Sequence>
<Script code="v := 'a'"/><Sleep msec="100"/><UnsetBlackboard key="v"/><Script code="v := 'b'"/><Sleep msec="100"/>
</Sequence></BehaviorTree></root>)");
  const std::string file = directory.path("run.jsonl"), property = "sometimes {v} == 'b'";
  const Outcome run = run_lockstep({"run", tree, "--clock", "virtual", "--rate", "10", "--view",
                                    "none", "--record", file, "--property", property});
  CHECK(contains(run.out, property + ": holds"));
  CHECK(run_lockstep({"log", "check", file, "--property", property}).code == 0);
  CHECK(run_lockstep({"log", "events", file, "--event", "entry", "--format", "csv"}).out ==
        "tick,time_s,event,what,value\n0,0,entry,v,a\n1,0.1,entry,v,b\n");
}

TEST_CASE("check takes a tree without its plugins, and --strict does not") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", document(kNodes));
  const Outcome noted = run_lockstep({"check", tree});
  CHECK(noted.code == 0);
  CHECK(noted.out == tree + ": ok\n");
  for (const char* id : {"Dock", "Rate", "Pick", "IsOpen"}) {
    CHECK(contains(noted.err, "note: no plugin has '" + std::string(id) + "'"));
  }
  const Outcome strict = run_lockstep({"check", "--strict", tree});
  CHECK(strict.code == 3);
  CHECK(contains(strict.err, "error: unknown node 'Dock'"));
  CHECK(run_lockstep({"show", tree}).code == 0);
  const Outcome run = run_lockstep({"run", tree, "--clock", "virtual"});
  CHECK(run.code == 3);
  CHECK(contains(run.err, "error: unknown node 'Dock'"));
}

TEST_CASE("run --mock runs a tree before its plugins exist") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", document(kNodes));
  const Outcome outcome = run_mocked(tree, {});
  CHECK(outcome.code == 0);
  const auto summary = parse_json(outcome.out);
  CHECK(summary["result"] == "success");
  const int ticks = summary["ticks"];
  CHECK(run_mocked(tree, {"--mock-leaf", "Dock=success:2"}).code == 0);
  CHECK(parse_json(run_mocked(tree, {"--mock-leaf", "Dock=success:2"}).out)["ticks"] > ticks);
  CHECK(run_mocked(tree, {"--mock-leaf", "IsOpen=failure"}).code == 1);
  CHECK(run_mocked(tree, {"--mock-leaf", "Pick=running", "--max-ticks", "50"}).code == 124);
}

TEST_CASE("run --mock is for lockstep's own trees, too, and for leaves of plugins") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", tree_text("<ParallelAbsolute barriers=\"1\"><Dock/><Advance step=\"0.5\"/>"
                            "</ParallelAbsolute>"));
  CHECK(run_lockstep({"check", tree}).code == 3);
  CHECK(run_mocked(tree, {}).code == 0);
  CHECK(run_mocked(tree, {"--mock-leaf", "Advance=failure"}).code == 1);
}

TEST_CASE(
    "run --mock takes ports by pattern, of leaves that no plugin has and of those of plugins") {
  const TemporaryDirectory directory;
  for (const std::string root : {"lockstep=\"1\"", "BTCPP_format=\"4\""}) {
    const auto tree = [&](const std::string& node) {
      return directory.file("tree.xml", "<root " + root + "><BehaviorTree ID=\"T\">" + node +
                                            "</BehaviorTree></root>");
    };
    const Outcome unknown = run_mocked(tree(R"(<Drive goal.x="1" result.path="{p}"/>)"),
                                       {"--mock-leaf", "Drive=failure"});
    INFO(unknown.err);
    CHECK(unknown.code == 1);
    const Outcome known =
        run_mocked(tree(R"(<Shape kind="round" size.radius="1" out.area="{a}"/>)"),
                   {"--plugin", abi_plugin("shapes_sdk"), "--mock-leaf", "Shape=failure"});
    INFO(known.err);
    CHECK(known.code == 1);
  }
}

TEST_CASE("run --mock takes a port that no plugin declares as the tree uses it") {
  const TemporaryDirectory directory;
  const std::string ports = directory.file(
      "ports.xml", tree_text("<Sequence memory=\"true\"><MoveTo goal=\"home\"/>"
                             "<MoveTo goal=\"{spot}\"/><Look at=\"{spot}\"/></Sequence>"));
  CHECK(run_mocked(ports, {}).code == 0);
  // Its entry has the type that a script or another node gives it.
  const std::string entries = directory.file(
      "entries.xml",
      tree_text("<Sequence memory=\"true\"><Script code=\"x := 1\"/><Look at=\"{x}\"/>"
                "<Check code=\"x + 1 == 2 &amp;&amp; charge > 20\"/><Measure charge=\"{charge}\" "
                "plan=\"{plan}\"/><ParallelAbsolute barriers=\"{plan}\"><A/><B/>"
                "</ParallelAbsolute></Sequence>"));
  CHECK(run_mocked(entries, {"--set", "charge=30", "--set", "plan=0.5"}).code == 0);
  const Outcome without = run_mocked(entries, {"--set", "plan=0.5"});
  CHECK(without.code == 5);
  CHECK(contains(without.out, "without a value"));
}

TEST_CASE("run --mock needs no plugin that is not there yet") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><plugin name=\"arm\"/><plugin name=\"grip\" program=\"grip.py\"/>"
      "<plugin name=\"motion\"/><BehaviorTree ID=\"Main\"><Sequence memory=\"true\"><Condition "
      "ID=\"IsOpen\"/>"
      "<Action ID=\"MoveTo\"/><Advance step=\"0.5\"/></Sequence></BehaviorTree></root>");
  CHECK(run_lockstep({"run", tree}).code == 4);
  const Outcome outcome = run_mocked(tree, {});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "warning: plugin 'arm' is not found"));
  CHECK(contains(outcome.err, "warning: plugin 'grip' is not found"));
  // One that is there is not mocked: its parameters are checked.
  const std::string wrong = directory.file(
      "wrong.xml",
      "<root lockstep=\"1\"><plugin name=\"arm\"/><plugin name=\"motion\"/><BehaviorTree "
      "ID=\"Main\"><Advance stpe=\"0.5\"/></BehaviorTree></root>");
  CHECK(contains(run_mocked(wrong, {}).err, "error: 'Advance' has no parameter 'stpe'"));
  // What the command line names must be there.
  CHECK(run_mocked(tree, {"--plugin", "leg"}).code == 4);
}

TEST_CASE("run --mock and check say which leaves are taken for actions") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"A\"><Sequence><IsOpen/><Condition ID=\"IsFar\"/>"
      "<Inverter><Dock/></Inverter></Sequence></BehaviorTree></root>");
  const std::string all = "warning: no plugin has 'Dock', 'IsOpen': taken for actions";
  CHECK(contains(run_mocked(tree, {}).err, ":1:55: " + all));
  CHECK(contains(run_mocked(tree, {"--mock-leaf", "Dock=failure"}).err,
                 "warning: no plugin has 'IsOpen': taken for an action"));
  const Outcome check = run_lockstep({"check", tree});
  CHECK(contains(check.err, "note: no plugin has 'IsOpen'; it is taken for an action"));
  CHECK_FALSE(contains(check.err, "'IsFar'; it is taken"));
}

TEST_CASE("run --mock-leaf refuses a node that the tree does not have, or that is no leaf") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"A\"><Sequence><Dock/><Inverter><Undock/>"
      "</Inverter></Sequence></BehaviorTree></root>");
  const Outcome misspelled = run_mocked(tree, {"--mock-leaf", "Dokc=failure"});
  CHECK(misspelled.code == 2);
  CHECK(contains(misspelled.err, "--mock-leaf Dokc: the tree has no such node"));
  CHECK(contains(misspelled.err, "did you mean 'Dock'?"));
  CHECK(contains(run_mocked(tree, {"--mock-leaf", "left_arm=failure"}).err,
                 "hint: it takes the ID of a leaf, not its name: 'Dock', 'Undock'"));
  const Outcome control = run_mocked(tree, {"--mock-leaf", "Sequence=failure"});
  CHECK(control.code == 2);
  CHECK(contains(control.err, "--mock-leaf Sequence: only a leaf has a result"));
}

TEST_CASE("run --mock-leaf takes a result and a time") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", document(kNodes));
  for (const char* wrong :
       {"Dock=maybe", "Dock=success:", "Dock=success:-1", "Dock=failure:1s", "Dock"}) {
    INFO(wrong);
    const Outcome outcome = run_mocked(tree, {"--mock-leaf", wrong});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "--mock-leaf"));
  }
}

TEST_CASE("files of ROS packages are found in AMENT_PREFIX_PATH, or where --ros-package says") {
  const TemporaryDirectory directory;
  directory.file("part.xml", document("<AlwaysSuccess/>"));
  const std::string tree =
      directory.file("tree.xml",
                     "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main tree\">"
                     "<include ros_pkg=\"arms\" path=\"part.xml\"/></root>");
  const Outcome missing = run({.arguments = {"check", tree},
                               .environment = {{"AMENT_PREFIX_PATH", directory.path("none")}}});
  CHECK(missing.code == 3);
  CHECK(contains(missing.err, "the ROS package 'arms' is not found"));
  CHECK(run_lockstep({"check", "--ros-package", "arms=" + directory.path("."), tree}).code == 0);
}

TEST_CASE("nodes --format btcpp is a model of what Groot2 does not know") {
  const Outcome outcome = run_lockstep({"nodes", "--plugin", "motion", "--format", "btcpp"});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "<root BTCPP_format=\"4\">\n  <TreeNodesModel>\n"));
  CHECK(contains(outcome.out, "    <Control ID=\"ParallelAbsolute\">\n"));
  CHECK(contains(outcome.out, "    <Action ID=\"Advance\">\n"));
  CHECK(contains(outcome.out, "<input_port name=\"step\" type=\"double\" default=\"0.01\">"));
  CHECK(contains(outcome.out, "type=\"std::vector&lt;double&gt;\""));
  CHECK_FALSE(contains(outcome.out, "\"Sequence\""));
  // A document with it can be checked without the plugin.
  const TemporaryDirectory directory;
  const std::string model = outcome.out.substr(outcome.out.find("  <TreeNodesModel>"));
  const std::string tree =
      directory.file("tree.xml",
                     "<root BTCPP_format=\"4\"><BehaviorTree><ParallelAbsolute barriers=\"1\">\n"
                     "<Advance step=\"fast\"/></ParallelAbsolute></BehaviorTree>\n" +
                         model);
  const Outcome checked = run_lockstep({"check", tree});
  CHECK(checked.code == 0);
  CHECK(contains(checked.err, "tree.xml:2:16: warning: 'fast' is not a number"));
}

TEST_CASE("a model that is older than the tree is a hint for every command, and a leaf is not") {
  const TemporaryDirectory directory;
  const std::string trees =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Advance step=\"0.5\" "
      "lift=\"{high}\"/></BehaviorTree><TreeNodesModel><Action ID=\"Advance\"><input_port "
      "name=\"step\" type=\"int\"/></Action></TreeNodesModel></root>";
  const std::string tree = directory.file("tree.xml", trees);
  CHECK(run_lockstep({"check", tree}).code == 0);
  CHECK(run_lockstep({"show", tree}).code == 0);
  CHECK(run_lockstep({"verify", "--mock", tree}).code == 0);
  const Outcome run = run_mocked(tree, {"--set", "high=1"});
  CHECK(run.code == 0);
  CHECK(contains(run.err, "warning: '0.5' is not a whole number, which 'step' is in the model"));
  CHECK(contains(run.err, "warning: the model of 'Advance' has no port 'lift'"));
  const Outcome known = run_lockstep({"check", "--plugin", "motion", tree});
  CHECK(known.code == 3);
  CHECK(contains(known.err, "error: 'Advance' has no port 'lift'"));
  CHECK_FALSE(contains(known.err, "whole number"));
}

TEST_CASE(
    "run --mock writes outputs: a value of the type in the model, or what --mock-output says") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence><Look level=\"{level}\" "
      "seen=\"{seen}\"/><Guess what=\"{what}\"/>"
      "<ScriptCondition code=\"level == 0.5 &amp;&amp; what == 'a cat'\"/></Sequence>"
      "</BehaviorTree><TreeNodesModel><Action ID=\"Look\"><output_port name=\"level\" "
      "type=\"double\"/><output_port name=\"seen\" "
      "type=\"bool\"/></Action></TreeNodesModel></root>");
  const std::vector<std::string> said{"--mock-output", "level=0.5", "--mock-output",
                                      "Guess.what=a cat"};
  CHECK(run_mocked(tree, said).code == 0);
  CHECK(run_mocked(tree, {"--mock-output", "Guess.what=a cat"}).code == 1);  // level is 0
  CHECK(run_mocked(tree, {"--mock-output", "level=0.5"}).code == 5);         // what has no value
  const Outcome unknown = run_mocked(tree, {"--mock-output", "far=1"});
  CHECK(unknown.code == 2);
  CHECK(contains(unknown.err, "--mock-output far: no stand-in has such an output"));
  const Outcome wrong = run_mocked(tree, {"--mock-output", "level=high"});
  CHECK(wrong.code == 2);
  CHECK(contains(wrong.err, "'level' of 'Look' is a number"));
  for (const std::string command : {"check", "show", "verify"}) {
    INFO(command);
    const auto call = [&](std::vector<std::string> more) {
      more.insert(more.begin(), {command, tree, "--mock"});
      if (command == "verify") more.insert(more.end(), {"--out", directory.path("out")});
      return run_lockstep(more);
    };
    CHECK(call(said).code == 0);
    CHECK(contains(call({"--mock-output", "far=1"}).err, "no stand-in has such an output"));
    CHECK(contains(call({"--mock-output", "level=high"}).err, "'level' of 'Look' is a number"));
  }
  std::vector<std::string> verify{"verify", tree, "--mock", "--out", directory.path("out")};
  CHECK(contains(run_lockstep(verify).err, "nothing declares which values"));
  verify.insert(verify.end(), said.begin(), said.end());
  const Outcome verified = run_lockstep(verify);
  INFO(verified.out << verified.err);
  CHECK(contains(verified.out, "'Look' writes 0.5 to 'level'"));
  verify.insert(verify.end(), {"--mock-output", "level=0.25"});
  CHECK(contains(run_lockstep(verify).out, "results         failure"));
}

TEST_CASE("run --mock takes a SubTree whose tree is not there, and check, and show") {
  const TemporaryDirectory directory;
  for (const std::string root : {"lockstep=\"1\"", "BTCPP_format=\"4\""}) {
    const std::string tree = directory.file(
        "tree.xml", "<root " + root +
                        "><BehaviorTree ID=\"Main\"><SubTree ID=\"Move to Waypoint\" "
                        "waypoint=\"home\" at=\"{spot}\" _autoremap=\"true\"/>"
                        "</BehaviorTree></root>");
    INFO(root);
    const Outcome run = run_mocked(tree, {});
    INFO(run.err);
    CHECK(run.code == 0);
    CHECK(contains(run.err, "warning: unknown tree 'Move to Waypoint'"));
    CHECK(run_mocked(tree, {"--mock-leaf", "Move to Waypoint=failure"}).code == 1);
    CHECK(run_lockstep({"check", "--mock", tree}).code == 0);
    CHECK(contains(run_lockstep({"show", "--mock", tree}).out, "Move to Waypoint"));
    CHECK(contains(run_lockstep({"run", tree}).err, "error: unknown tree 'Move to Waypoint'"));
  }
}

TEST_CASE("a root that is skipped ends the run, not with Success") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", document("<Dock _skipIf=\"true\"/>"));
  const Outcome outcome = run_mocked(tree, {});
  CHECK(outcome.code == 1);
  CHECK(parse_json(outcome.out)["result"] == "skipped");
}

TEST_CASE("what asks for another tick for ever is a fault, unless a period is one tick") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", document("<RetryUntilSuccessful num_attempts=\"-1\"><AlwaysFailure/>"
                           "</RetryUntilSuccessful>"));
  const Outcome endless = run_mocked(tree, {});
  CHECK(endless.code == 5);
  CHECK(contains(endless.err, "'Main tree/RetryUntilSuccessful'"));
  CHECK(contains(endless.err, "requested another tick 10000 times in one period"));
  CHECK(run_mocked(tree, {"--tick", "exactly-once", "--max-ticks", "5"}).code == 124);
}

TEST_CASE("a start value of a SubTree counts as written, once") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"A\"><BehaviorTree ID=\"A\">"
      "<SubTree ID=\"B\" goal=\"dock\"/></BehaviorTree><BehaviorTree ID=\"B\"><Sequence>"
      "<WasEntryUpdated entry=\"{goal}\"/><Inverter><Repeat num_cycles=\"2\">"
      "<WasEntryUpdated name=\"again\" entry=\"{goal}\"/></Repeat></Inverter>"
      "</Sequence></BehaviorTree></root>");
  CHECK(run_mocked(tree, {}).code == 0);
}

TEST_CASE("a ParallelAll is measured as each parallel is, in a recording too") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root BTCPP_format=\"4\"><plugin name=\"motion\"/><BehaviorTree ID=\"Main\"><ParallelAll "
      "name=\"both\"><Advance step=\"0.1\"/><Advance step=\"0.3\"/></ParallelAll></BehaviorTree>"
      "</root>");
  const std::string file = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--record", file}).code == 0);
  const Outcome measured = run_lockstep({"log", "measure", file});
  CHECK(contains(measured.out, "Main/both  progress-distance  3.3"));
}
