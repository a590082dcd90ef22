// lockstep verify from outside, and that what it found comes again with run --leaves.
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

constexpr auto kHead = "<root lockstep=\"1\"><plugin name=\"motion\"/>";

struct Case {
  std::string_view claim, beside, tree, leaves, finding;
};

// clang-format off
const Case kCases[] = {
  {"a circle of barriers",
   R"(<barrier name="coarse" barriers="0.5"/><barrier name="fine" barriers="0.25"/>)",
   R"(<Parallel><SyncProgress barrier="coarse"><SyncProgress barrier="fine">
      <Advance name="a" step="0.05"/></SyncProgress></SyncProgress>
      <SyncProgress barrier="coarse"><Sequence memory="true"><Advance name="b" step="0.05"/>
      <SyncProgress barrier="fine"><Advance name="c" step="0.05"/></SyncProgress></Sequence>
      </SyncProgress></Parallel>)",
   R"(<leaf path="*" finish="full" result="success"/>)", "trap"},
  {"an action that is halted again and again", "",
   R"(<Fallback><Sequence><Check code="n == 1"/><Advance name="a" step="0.05"/></Sequence>
      <Timeout seconds="0.3"><Advance name="b" step="0.1"/></Timeout><AlwaysRunning/></Fallback>)",
   R"(<leaf path="*" result="failure" ticks="2..3"/>)", "trap"},
  {"a leaf that drifts while it is held", R"(<barrier name="g" barriers="0.5"/>)",
   R"(<Parallel><SyncProgress barrier="g"><Advance name="a" step="0.05"/></SyncProgress>
      <Fallback><Advance name="b" step="0.5"/><SyncProgress barrier="g">
      <Advance name="c" step="0.05"/></SyncProgress></Fallback></Parallel>)",
   R"(<leaf path="*" finish="full" result="success" held="-1..0"/>)", "cycle"},
};
// clang-format on

std::string root_of(const Case& it) {
  std::string beside(it.beside);
  const std::string value = it.tree.find("n == 1") == std::string_view::npos ? "" : " n=\"0\"";
  std::string tree(it.tree);
  if (!value.empty()) {
    tree = "<Sequence memory=\"true\"><Script code=\"n := 0\"/>" + tree + "</Sequence>";
  }
  return kHead + beside + "<BehaviorTree ID=\"T\">" + tree + "</BehaviorTree></root>";
}

}  // namespace

TEST_CASE("a finding with a cut comes again with run --leaves, which cuts the run there") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "t.xml", std::string(kHead) +
                   R"(<BehaviorTree ID="T"><Fallback memory="true"><Timeout seconds="0.3">
                      <Advance name="a" step="0.05"/></Timeout><AlwaysRunning/></Fallback>
                      </BehaviorTree></root>)");
  const std::string leaves = directory.file(
      "t.leaves.xml",
      R"(<leaves lockstep="1"><leaf path="*" result="success" ticks="3"/></leaves>)");
  const std::string stem = directory.path("t.trap-after-cut"), again = directory.path("again");
  const std::string scenarios = directory.path("t.test.xml");
  const Outcome verified = run_lockstep({"verify", tree, "--leaves", leaves, "--cuts", "--out",
                                         directory.path("."), "--save", scenarios});
  INFO(verified.out << verified.err);
  REQUIRE(verified.code == 1);
  CHECK(contains(verified.out, "finding trap-after-cut: "));
  CHECK(
      contains(verified.out, "; the process is cut at most 1 time in a run, and loses no tick; "));
  CHECK(contains(verified.err,
                 "note: --save leaves out trap-after-cut: a scenario cannot hold a cut"));
  CHECK_FALSE(std::filesystem::exists(scenarios));
  CHECK(contains(read_file(stem + ".leaves"), "\n@cut "));
  const Outcome played = run_lockstep({"run", tree, "--leaves", stem + ".leaves", "--clock",
                                       "virtual", "--view", "none", "--record", again});
  constexpr auto kCut =
      "cut: the process ends here and is resumed; 'T/Fallback/Timeout/a' starts again";
  CHECK(contains(played.err, kCut));
  CHECK(contains(read_file(again), kCut));
  CHECK(contains(read_file(stem + ".jsonl"), kCut));
  CHECK(run_lockstep({"log", "diff", stem + ".jsonl", again}).code == 0);

  const Outcome json = run_lockstep(
      {"verify", tree, "--leaves", leaves, "--cuts", "1", "--out", directory.path("."), "--json"});
  CHECK(contains(json.out, "\"cuts\": 1"));
  CHECK(contains(json.out, "\"cut_before\": ["));
  CHECK(contains(run_lockstep({"verify", tree, "--leaves", leaves, "--cuts", "0", "--out",
                               directory.path(".")})
                     .out,
                 "finding never-ticked/T/Fallback/AlwaysRunning: "));
  const std::string other = directory.file(
      "other.xml",
      std::string(kHead) +
          R"(<BehaviorTree ID="T"><Advance name="a" step="0.05"/></BehaviorTree></root>)");
  CHECK(contains(run_lockstep({"verify", other, "--cuts", "2"}).out,
                 "\nverified for all behaviors that are assumed, with at most 2 cuts\n"));
}

TEST_CASE("a finding in which leaves continue or fail after a cut comes again, too") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "t.xml",
      std::string(kHead) +
          R"(<BehaviorTree ID="T"><Parallel failure_count="2"><Advance name="a" step="0.05"/>
                      <Advance name="b" step="0.05"/></Parallel></BehaviorTree></root>)");
  const std::string leaves = directory.file(
      "t.leaves.xml",
      R"(<leaves lockstep="1"><leaf path="*" result="success" ticks="3" on_resume="continue"/>
         <leaf path="*/b" on_resume="failure"/></leaves>)");
  const std::string stem = directory.path("t.property.sure"), again = directory.path("again");
  const Outcome verified =
      run_lockstep({"verify", tree, "--leaves", leaves, "--cuts", "--out", directory.path("."),
                    "--property", "sure: never b.failure"});
  INFO(verified.out << verified.err);
  REQUIRE(verified.code == 1);
  CHECK(contains(read_file(stem + ".leaves"),
                 "@cut 1\n@cut 1 continue T/Parallel/a\n@cut 1 failure T/Parallel/b\n"));
  const Outcome played = run_lockstep({"run", tree, "--leaves", stem + ".leaves", "--clock",
                                       "virtual", "--view", "none", "--record", again});
  CHECK(contains(played.err, "; 'T/Parallel/a' continues at "));
  CHECK(contains(played.err, "; 'T/Parallel/b' counts as failed"));
  CHECK(run_lockstep({"log", "diff", stem + ".jsonl", again}).code == 0);
  CHECK(contains(run_lockstep({"verify", tree, "--cuts", "--on-resume", "success", "--out",
                               directory.path(".")})
                     .out,
                 "has a result at once (2 actions)"));
}

TEST_CASE("what verify has found comes again with run --leaves") {
  for (const Case& it : kCases) {
    INFO(it.claim);
    const TemporaryDirectory directory;
    const std::string tree = directory.file("t.xml", root_of(it));
    const std::string leaves = directory.file(
        "t.leaves.xml", "<leaves lockstep=\"1\">" + std::string(it.leaves) + "</leaves>");
    const std::string out = directory.path("found");
    const Outcome verified = run_lockstep({"verify", tree, "--leaves", leaves, "--out", out});
    INFO(verified.out << verified.err);
    REQUIRE(verified.code == 1);
    CHECK(contains(verified.out, "finding " + std::string(it.finding)));
    const std::string stem = out + "/t." + std::string(it.finding), again = directory.path("again");
    CHECK(contains(verified.out, "\n       lockstep replay " + stem + ".jsonl\n"));
    const Outcome played = run_lockstep({"run", tree, "--leaves", stem + ".leaves", "--clock",
                                         "virtual", "--view", "none", "--record", again});
    INFO(played.err);
    CHECK(played.code != 2);
    const Outcome diff = run_lockstep({"log", "diff", stem + ".jsonl", again});
    CHECK(diff.code == 0);
    CHECK(diff.out.empty());
    const std::string recording = read_file(stem + ".jsonl");
    CHECK(contains(recording.substr(0, recording.find('\n')),
                   "\"verify\":\"" + std::string(it.finding) + ": "));
    CHECK(contains(run_lockstep({"log", "info", stem + ".jsonl"}).out,
                   "\n  found by verify: " + std::string(it.finding) + ": "));
  }
}

TEST_CASE("a run that shows a finding has all ticks of a leaf, also several in one period") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root BTCPP_format="4"><plugin name="motion"/>
      <BehaviorTree ID="T"><Parallel><AsyncSequence><Advance name="x"/><Advance name="y"/>
      </AsyncSequence><Advance name="a"/></Parallel></BehaviorTree></root>)");
  const std::string out = directory.path("found");
  for (const std::string property : {"a.running leads to a.failure", "never a.success"}) {
    INFO(property);
    const Outcome verified = run_lockstep({"verify", tree, "--property", property, "--out", out});
    CHECK(verified.code == 1);
    const auto from = verified.out.find("lockstep replay ") + 16;
    const std::string recording = verified.out.substr(from, verified.out.find('\n', from) - from);
    INFO(verified.out);
    CHECK(run_lockstep({"log", "check", recording, "--property", property}).code == 1);
  }
}

TEST_CASE("times of an entry that nothing writes have no more states than those of a number") {
  const TemporaryDirectory directory;
  for (const std::string node : {"Delay", "Rate", "Cooldown", "Timeout"}) {
    const auto states = [&](const std::string& seconds) {
      const std::string tree =
          directory.file("tree.xml",
                         "<root lockstep=\"1\" main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\">"
                         "<SubTree ID=\"S\" s=\"0.3\"/></BehaviorTree><BehaviorTree ID=\"S\">"
                         "<Repeat><ForceSuccess><" +
                             node + " seconds=\"" + seconds + "\"><Action ID=\"A\"/></" + node +
                             "></ForceSuccess></Repeat>"
                             "</BehaviorTree></root>");
      const Outcome outcome = run_lockstep(
          {"verify", tree, "--mock", "--states", "1000", "--out", directory.path("."), "--json"});
      return parse_json(outcome.out)["states"].get<int>();
    };
    INFO(node);
    CHECK(states("{s}") == states("0.3"));
  }
}

TEST_CASE("an output that its entry does not take is a fault, also where nothing reads the entry") {
  const TemporaryDirectory directory;
  const auto verified = [&](const std::string& start) {
    const std::string tree = directory.file(
        "tree.xml", R"(<root BTCPP_format="4" main_tree_to_execute="M"><BehaviorTree ID="M">
<SubTree ID="S" ok=")" + start +
                        R"("/></BehaviorTree><BehaviorTree ID="S"><Action ID="A" ok="{ok}"/>
</BehaviorTree><TreeNodesModel><Action ID="A"><output_port name="ok" type="int"/></Action>
</TreeNodesModel></root>)");
    return run_lockstep({"verify", tree, "--mock", "--out", directory.path(".")}).out;
  };
  CHECK(contains(verified("no"), "tree.xml:2:62) sets an output that its entry does not take"));
  CHECK(contains(verified("5"), "verified for all behaviors"));
}

TEST_CASE("Repeat and Retry end where an entry gives fewer rounds than are done") {
  const TemporaryDirectory directory;
  const auto outcome = [&](const std::string& node, const std::string& last) {
    const std::string tree =
        directory.file("tree.xml",
                       "<root lockstep=\"1\"><BehaviorTree ID=\"M\"><Sequence memory=\"true\">"
                       "<Script code=\"n := 0; k := 3\"/><" +
                           node +
                           "=\"{k}\"><Sequence memory=\"true\">"
                           "<Script code=\"n += 1; k = n == 2 ? 1 : k\"/>" +
                           last + "</Sequence></" + node.substr(0, node.find(' ')) +
                           "></Sequence></BehaviorTree></root>");
    CHECK(contains(
        run_lockstep({"verify", tree, "--states", "1000", "--out", directory.path(".")}).out,
        "verified for all behaviors"));
    return run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--max-ticks", "20"})
        .code;
  };
  CHECK(outcome("Repeat times", "<AlwaysSuccess/>") == 0);
  CHECK(outcome("Retry attempts", "<AlwaysFailure/>") == 1);
}

TEST_CASE("a tree without findings is verified, with what is assumed") {
  const TemporaryDirectory directory;
  const Outcome it = run_lockstep(
      {"verify", LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml", "--out", directory.path("out")});
  CHECK(it.code == 0);
  CHECK(contains(it.out, "complete"));
  CHECK(contains(it.out, "results"));
  CHECK(contains(it.out, "assumed: ticks come at 10 Hz"));
  CHECK(it.out.ends_with("verified for all behaviors that are assumed\n"));
  CHECK_FALSE(std::filesystem::exists(directory.path("out")));
}

TEST_CASE("where each end is a fault, the results say so") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="M">
<Sequence><Script code="x := 0"/><Repeat times="{x}"><AlwaysSuccess/></Repeat></Sequence></BehaviorTree></root>)");
  const Outcome it = run_lockstep({"verify", tree, "--out", directory.path("out")});
  CHECK(it.code == 1);
  CHECK(contains(it.out, "none: each end is a fault"));
}

TEST_CASE("a leaf that returns Skipped is named as what is not assumed") {
  const TemporaryDirectory directory;
  std::filesystem::permissions(directory.file("skip.py", R"(#!/usr/bin/env python3
import json, sys
def say(**what): print(json.dumps(what), flush=True)
say(lockstep=1, leaves=[{"id": "Maybe"}])
for line in sys.stdin:
    request = json.loads(line)
    if request["do"] == "tick": say(leaf=request["leaf"], status="skipped")
    elif request["do"] in ("create", "halt"): say(leaf=request["leaf"], done=True)
)"),
                               std::filesystem::perms::owner_all);
  const std::string tree =
      directory.file("t.xml", R"(<root lockstep="1"><plugin name="skip" program="skip.py"/>
<BehaviorTree ID="T"><Fallback memory="true"><ForceSuccess><Maybe/></ForceSuccess>
<Script name="k" code="x := 1"/></Fallback></BehaviorTree></root>)");
  const std::string property = "q: never k.ticked";
  CHECK(contains(run_lockstep({"run", tree, "--plugin-path", directory.path(""), "--clock",
                               "virtual", "--view", "none", "--property", property})
                     .err,
                 "property q is violated in tick 0"));
  const Outcome checked = run_lockstep(
      {"check", "--strict", tree, "--run-programs", "--plugin-path", directory.path("")});
  INFO(checked.err);
  CHECK(checked.code == 0);
  CHECK(contains(checked.err, "note: 'k' can never run, unless a leaf returns Skipped"));
  const auto verified = [&](const std::string& results) {
    const std::string leaves = directory.file(
        "t.leaves.xml", "<leaves lockstep=\"1\"><leaf path=\"*\"" + results + "/></leaves>");
    return run_lockstep({"verify", tree, "--run-programs", "--plugin-path", directory.path(""),
                         "--leaves", leaves, "--property", property, "--out",
                         directory.path("out")})
        .out;
  };
  constexpr auto kAssumed =
      "no leaf without result=\"…\" in the leaf model returns Skipped (1 leaf)";
  CHECK(contains(verified(""), kAssumed));
  const std::string said = verified(" result=\"success;failure;skipped\"");
  INFO(said);
  CHECK_FALSE(contains(said, kAssumed));
  CHECK(contains(said, "finding property/q"));
}

TEST_CASE("that progress does not fall is named as assumed, where it matters") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="T">
<ParallelAbsolute barriers="0.5"><Action ID="A"/><Action ID="B"/></ParallelAbsolute></BehaviorTree></root>)");
  const auto verified = [&](const std::string& step) {
    const std::string leaves = directory.file(
        "t.leaves.xml", "<leaves lockstep=\"1\"><leaf path=\"*/A\"" + step + "/></leaves>");
    return run_lockstep(
               {"verify", tree, "--mock", "--leaves", leaves, "--out", directory.path("out")})
        .out;
  };
  const std::string assumed =
      "no action without step=\"…\" in the leaf model loses progress while it is ticked (";
  CHECK(contains(verified(""), assumed + "2 actions)"));
  CHECK(contains(verified(" step=\"-1..1\""), assumed + "1 action)"));
  CHECK(contains(verified(" progress=\"none\""), assumed + "1 action)"));
}

TEST_CASE("what a limit has stopped is not called verified") {
  const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/predictability.xml";
  for (const auto& limit :
       {std::vector<std::string>{"--states", "50"}, {"--depth", "1"}, {"--time", "0"}}) {
    const Outcome it = run_lockstep({"verify", tree, limit[0], limit[1]});
    INFO(it.out);
    CHECK(it.code == 124);
    CHECK(contains(it.out, "\nbounded: nothing found in the first "));
    CHECK_FALSE(contains(it.out, "verified"));
  }
}

TEST_CASE("what a limit has stopped names what costs, and what helps") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "t.xml", kHead + std::string(R"(<BehaviorTree ID="T"><Timeout name="slow" seconds="60">
<ParallelRelative delta="0.05"><Advance name="a"/><Advance name="b"/><Advance name="c"/>
</ParallelRelative></Timeout></BehaviorTree></root>)"));
  const Outcome it = run_lockstep({"verify", tree, "--states", "200"});
  INFO(it.out << it.err);
  CHECK(it.code == 124);
  CHECK(contains(
      it.out, "\n  what costs: 3 leaves may take any of 21 steps of progress in a tick: T/slow/"));
  CHECK(contains(it.out,
                 "\n  what costs: 'T/slow' counts 600 ticks: 60 s at 10 Hz\n    remedy: "
                 "--rate 0.167"));
  CHECK(contains(it.out, "\n    remedy: step=\"0..1\" in the leaf model"));
  CHECK(contains(it.out, " --save-model FILE` writes a leaf model to fill in\n"));
  const auto json = parse_json(run_lockstep({"verify", tree, "--states", "200", "--json"}).out);
  CHECK(json["costs"].size() == 3);
  // What is small, and a depth that somebody asked for, is no cost.
  CHECK_FALSE(contains(run_lockstep({"verify", tree, "--depth", "1"}).out, "what costs"));
  const std::string door = LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml";
  CHECK_FALSE(contains(run_lockstep({"verify", door}).out, "what costs"));
}

TEST_CASE("what costs is found fast in a tree of very many leaves that run at once") {
  constexpr int kLeaves = 20'000;
  std::string leaves;
  for (int i = 0; i < kLeaves; ++i) leaves += "<Advance/>";
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml", std::string(kHead) + "<BehaviorTree ID=\"T\"><Parallel>" + leaves +
                                  "</Parallel></BehaviorTree></root>");
  const Outcome it = run_lockstep({"verify", tree, "--depth", "2", "--states", "1"});
  INFO(it.out.substr(0, 1000));
  CHECK(it.code == 124);
  CHECK(contains(it.out, "with 10^9542 combinations of results in a tick"));
}

TEST_CASE("verify --save-model writes a leaf model that changes no verdict, and replaces none") {
  const TemporaryDirectory directory;
  const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml",
                    model = directory.path("door.leaves.xml");
  const Outcome first = run_lockstep({"verify", tree, "--save-model", model});
  CHECK(first.code == 0);
  CHECK(contains(first.err, "wrote '" + model + "'"));
  const Outcome again = run_lockstep({"verify", tree, "--leaves", model});
  INFO(again.err << again.out);
  CHECK(again.code == 0);
  CHECK(contains(again.out, "\n  18 states"));
  CHECK(contains(first.out, "\n  18 states"));
  const std::string text = read_file(model);
  const Outcome kept = run_lockstep({"verify", tree, "--save-model", model});
  CHECK(kept.code == 2);
  CHECK(read_file(model) == text);
  // Also where verify cannot begin.
  const std::string mute =
      directory.file("m.xml", kHead + std::string(R"(<BehaviorTree ID="T"><Sequence memory="true">
<Advance name="a" actual="{x}"/><Check code="x &gt; 0.5"/></Sequence></BehaviorTree></root>)"));
  const std::string other = directory.path("m.leaves.xml");
  CHECK(run_lockstep({"verify", mute, "--save-model", other}).code == 3);
  CHECK(contains(read_file(other), "out.actual=\""));
  CHECK(run_lockstep({"verify", mute, "--leaves", other}).code <= 1);
}

TEST_CASE("verify --compact proves nothing, and says how likely a state was missed") {
  const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/predictability.xml";
  const std::vector<std::string> arguments{"verify", tree, "--compact"};
  const Outcome it = run_lockstep(arguments);
  INFO(it.out);
  CHECK(it.code == 124);
  CHECK(contains(it.out, "\nnot proven: nothing found in "));
  CHECK(contains(it.out, " states; one was missed with a probability below "));
  CHECK(contains(it.out, "no two states have the same hash"));
  CHECK_FALSE(contains(it.out, "verified"));
  const Outcome json = run_lockstep({"verify", tree, "--compact", "--json"});
  CHECK(contains(json.out, "\"missed_with_probability_below\": "));
  const Outcome junit = run_lockstep({"verify", tree, "--compact", "--format", "junit"});
  CHECK(contains(junit.out, "<skipped message=\"not proven: "));
}

TEST_CASE("a limit is heeded within a state of very many answers") {
  const TemporaryDirectory directory;
  std::string leaves;
  for (int i = 0; i < 40; ++i) leaves += "<Advance/>";
  const std::string tree =
      directory.file("tree.xml", std::string(kHead) + "<BehaviorTree ID=\"M\"><Parallel>" + leaves +
                                     "</Parallel></BehaviorTree></root>");
  for (const auto& limit : {std::vector<std::string>{"--states", "5000"}, {"--time", "0.1"}}) {
    const Outcome it = run_lockstep({"verify", tree, "--no-symmetry", limit[0], limit[1]});
    INFO(it.out);
    CHECK(it.code == 124);
    CHECK(contains(it.out, "\nbounded: nothing found in the first 0 ticks"));
  }
}

TEST_CASE(
    "the option --time counts from the start of the command: what it takes to load the tree") {
  const TemporaryDirectory directory;
  std::string leaves;
  for (int i = 0; i < 100'000; ++i) leaves += "<AlwaysSuccess/>";
  const std::string tree =
      directory.file("tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"M\"><Parallel>" + leaves +
                                     "</Parallel></BehaviorTree></root>");
  const Outcome it = run_lockstep({"verify", tree, "--time", "0.02"});
  INFO(it.out);
  CHECK(it.code == 124);
  CHECK(contains(it.out, "\nbounded: nothing found in the first 0 ticks (all behaviors), 1 state"));
}

TEST_CASE("a cycle in which somebody waits all the time says who waits for whom") {
  const TemporaryDirectory directory;
  const auto use = [](const std::string& leaf) {
    return "<UseResources pool=\"hand\" resources=\"tool\" keep=\"true\"><SyncProgress "
           "barrier=\"meet\"><Advance name=\"" +
           leaf + "\" step=\"0.1\"/></SyncProgress></UseResources>";
  };
  const std::string tree = directory.file(
      "t.xml", std::string(kHead) +
                   "<plugin name=\"fetch\"/><resources name=\"hand\"/>"
                   "<barrier name=\"meet\" barriers=\"0.5\"/><BehaviorTree ID=\"T\"><Parallel>" +
                   use("screw") + "<Sequence><BatteryAbove name=\"guard\" level=\"0.3\"/>" +
                   use("hold") + "</Sequence></Parallel></BehaviorTree></root>");
  const Outcome it = run_lockstep({"verify", tree, "--out", directory.path("out")});
  INFO(it.out);
  CHECK(it.code == 1);
  CHECK(contains(it.out, "\nfinding cycle: "));
  CHECK(contains(it.out, "'meet' holds "));
  CHECK(contains(it.out, "\n    in it: T/Parallel/Sequence/guard succeeded\n"));
}

TEST_CASE("children are alike in what they may do, whatever their names and constant ports") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml", std::string(kHead) +
                                  R"(<BehaviorTree ID="T"><ParallelAbsolute barriers="0.5">
                      <Advance name="left" step="0.05"/><Advance name="right" step="0.2"/>
                      </ParallelAbsolute></BehaviorTree></root>)");
  const Outcome it = run_lockstep({"verify", tree});
  CHECK(it.code == 0);
  CHECK(contains(it.out,
                 "left, right of T/ParallelAbsolute: they may do the same, so states in "
                 "which they have changed places count once"));
  const std::string rows = directory.file(
      "t.leaves.xml",
      R"(<leaves lockstep="1"><leaf path="*/left" ticks="20" result="success"/></leaves>)");
  CHECK_FALSE(contains(run_lockstep({"verify", tree, "--leaves", rows}).out, "left, right of"));
}

TEST_CASE("what cannot be verified is reported with its place") {
  const Outcome it = run_lockstep({"verify", LOCKSTEP_SOURCE_DIR "/trees/navigate.xml"});
  CHECK(it.code == 3);
  CHECK(contains(it.err, "navigate.xml:15:5: error: 'RecoveryNode' is a control node of plugin"));
  const Outcome entry = run_lockstep({"verify", LOCKSTEP_SOURCE_DIR "/trees/replanning.xml"});
  CHECK(entry.code == 3);
  CHECK(contains(entry.err, "declare them in the leaf model: <leaf of=\"Replan\" out.barriers="));
}

TEST_CASE("a leaf model with mistakes is refused") {
  const TemporaryDirectory directory;
  const std::string leaves =
      directory.file("l.xml", "<leaves lockstep=\"1\">\n<leaf of=\"Advanc\"/></leaves>");
  const Outcome it =
      run_lockstep({"verify", LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml", "--leaves", leaves});
  CHECK(it.code == 3);
  CHECK(contains(it.err, ":2:11: error: the tree has no leaf of type 'Advanc'"));
  CHECK(contains(it.err, "did you mean 'Advance'?"));
}

TEST_CASE("a verdict as JSON has what the text has") {
  const TemporaryDirectory directory;
  const Outcome it = run_lockstep({"verify", LOCKSTEP_SOURCE_DIR "/trees/fetch_and_carry.xml",
                                   "--json", "--out", directory.path("out")});
  CHECK(it.code == 1);
  const auto json = parse_json(it.out);
  CHECK(json["complete"] == true);
  CHECK(json["results"]["success"] == 1);
  REQUIRE(json["findings"].size() == 1);
  CHECK(json["findings"][0]["name"] == "cycle");
  CHECK(std::filesystem::exists(std::string(json["findings"][0]["recording"])));
}

namespace {

// A tree with two findings: an action that may be halted again and again, and a node without ticks.
std::string with_findings(const TemporaryDirectory& directory) {
  return directory.file("t.xml", std::string(kHead) +
                                     "<BehaviorTree ID=\"T\"><Sequence><Advance name=\"a&lt;b\"/>"
                                     "<Fallback><AlwaysSuccess/><Advance name=\"dead\"/></Fallback>"
                                     "<Advance/></Sequence></BehaviorTree></root>");
}

}  // namespace

TEST_CASE("any number of threads writes the same bytes") {
  const TemporaryDirectory directory;
  const auto verdict = [&](const std::string& jobs) {
    const std::string out = directory.path("out" + jobs);
    const Outcome it = run_lockstep(
        {"verify", with_findings(directory), "--jobs", jobs, "--out", out, "--format", "junit"});
    CHECK(it.code == 1);
    return it.out.substr(it.out.find("<testcase")) + read_file(out + "/t.cycle.leaves") +
           read_file(out + "/t.cycle.jsonl").substr(0, 200);
  };
  CHECK(verdict("1") == verdict("3"));
}

TEST_CASE("a verdict in the formats of other programs") {
  const TemporaryDirectory directory;
  const auto verdict = [&](const std::string& format) {
    return run_lockstep(
        {"verify", with_findings(directory), "--out", directory.path("out"), "--format", format});
  };
  const Outcome junit = verdict("junit");
  CHECK(junit.code == 1);
  CHECK(contains(junit.out, "tests=\"3\" failures=\"2\" skipped=\"0\""));
  CHECK(contains(junit.out, "name=\"can always end\"/>"));
  CHECK(contains(junit.out, "name=\"never-ticked/T/Sequence/Fallback/dead\"><failure message="));
  CHECK(verdict("json").out.starts_with("{"));
  CHECK(verdict("xml").code == 2);
}

TEST_CASE("a verdict is reported also where its files cannot be written") {
  const TemporaryDirectory directory;
  const std::string tree = with_findings(directory);
  const Outcome it = run_lockstep({"verify", tree, "--out", tree});
  CHECK(it.code == 2);
  CHECK(contains(it.err, "error: cannot "));
  CHECK(contains(it.out, "finding never-ticked/T/Sequence/Fallback/dead"));
  CHECK(it.out.ends_with("not verified: 2 findings\n"));
}

TEST_CASE("verify without a plugin of a node says that --mock takes it for a leaf") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "t.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"T\"><Lift/></BehaviorTree></root>");
  const Outcome without = run_lockstep({"verify", tree});
  CHECK(without.code == 3);
  CHECK(contains(without.err, "note: verify --mock takes nodes that no plugin has for leaves"));
  CHECK(run_lockstep({"verify", tree, "--mock"}).code == 0);
}

TEST_CASE("which findings count is what --only says") {
  const TemporaryDirectory directory;
  const auto only = [&](const std::string& pattern) {
    return run_lockstep(
        {"verify", with_findings(directory), "--out", directory.path("out"), "--only", pattern});
  };
  const Outcome none = only("trap");
  CHECK(none.code == 0);
  CHECK(contains(none.out, "no finding trap; --only leaves out "));
  CHECK(!contains(none.out, "verified"));
  const Outcome bounded = run_lockstep({"verify", with_findings(directory), "--out",
                                        directory.path("out"), "--only", "trap", "--depth", "1"});
  CHECK(bounded.code == 124);
  CHECK(contains(bounded.out, "bounded: nothing found in the first "));
  const Outcome mistyped = only("property/clsoe");
  CHECK(mistyped.code == 2);
  CHECK(contains(mistyped.err, "--only: there is no property 'property/clsoe'"));
  for (const char* const name :
       {"traps", "never-ticked", "never-ticked/T/Sequence/Falback", "never_ticked/*", "*trap"}) {
    INFO(name);
    const Outcome unknown = only(name);
    CHECK(unknown.code == (std::string_view(name) == "*trap" ? 0 : 2));
    CHECK(contains(unknown.err, "--only: no finding of this tree has the name") ==
          (unknown.code == 2));
  }
  CHECK(only("property/*").code == 0);
  CHECK(only("starvation/T/Sequence").code == 0);
  const Outcome dead = only("never-ticked/*");
  CHECK(dead.code == 1);
  CHECK(contains(dead.out, "finding never-ticked/T/Sequence/Fallback/dead"));
  CHECK_FALSE(contains(dead.out, "finding cycle"));
}

TEST_CASE("a finding with a very long name has a recording with a shorter one") {
  const TemporaryDirectory directory;
  const std::string name(300, 'a');
  const std::string tree =
      directory.file("t.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"T\"><AlwaysSuccess name=\"" +
                                  name + "\"/></BehaviorTree></root>");
  const Outcome outcome = run_lockstep({"verify", tree, "--out", directory.path("out"),
                                        "--property", name + ": never " + name + ".success",
                                        "--property", name + "b: never " + name + ".success"});
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "not verified: 2 findings"));
  const std::filesystem::directory_iterator files(directory.path("out"));
  CHECK(std::distance(begin(files), end(files)) == 4);
}

TEST_CASE("two properties have two names, and the same one twice is one") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml",
                     "<root lockstep=\"1\"><property name=\"p\">never a.failure</property>"
                     "<BehaviorTree ID=\"T\"><AlwaysSuccess name=\"a\"/></BehaviorTree></root>");
  const Outcome other = run_lockstep({"verify", tree, "--property", "p: never a.success"});
  CHECK(other.code == 2);
  CHECK(contains(other.err, "there is a property 'p' already: never a.failure"));
  CHECK(run_lockstep({"run", tree, "--property", "p: never a.success"}).code == 2);
  CHECK(run_lockstep({"verify", tree, "--property", "p: never a.failure"}).code == 0);
}

TEST_CASE("the script of a finding has what a leaf writes in a start that is a fault") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="T">
<Sequence><Script code="y := 1"/><Switch2 variable="{y}" case_1="0" case_2="1"><AlwaysSuccess/>
<A name="a" o="{y}"/><AlwaysSuccess/></Switch2></Sequence></BehaviorTree>
<TreeNodesModel><Action ID="A"><output_port name="o" type="int"/></Action></TreeNodesModel></root>)");
  const std::string model = directory.file(
      "t.leaves.xml",
      R"(<leaves lockstep="1"><leaf of="A" ticks="1" out.o="0|1" writes="start"/></leaves>)");
  const Outcome outcome =
      run_lockstep({"verify", tree, "--mock", "--leaves", model, "--out", directory.path("out")});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "finding fault/T/Sequence/Switch2/a"));
}

TEST_CASE("a folder or a missing file of properties is refused") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "t.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"T\"><AlwaysSuccess/></BehaviorTree></root>");
  for (const std::string& file : {directory.path(""), directory.path("none")}) {
    const Outcome outcome = run_lockstep({"verify", tree, "--property-file", file});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "cannot read it: "));
  }
}

TEST_CASE("run --leaves with a leaf model does what that allows, as the seed chooses") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml",
                     "<root lockstep=\"1\"><BehaviorTree ID=\"T\"><ParallelAbsolute "
                     "barriers=\"0.5\"><Lift/><Drive/>"
                     "</ParallelAbsolute></BehaviorTree></root>");  // leaves that no plugin has
  const auto runs = [&](const std::string& rows, const std::string& seed) {
    const std::string leaves =
        directory.file("l.xml", "<leaves lockstep=\"1\" rate=\"10\">" + rows + "</leaves>");
    return run_lockstep({"run", tree, "--leaves", leaves, "--clock", "virtual", "--view", "none",
                         "--seed", seed, "--json"});
  };
  std::set<std::string> outcomes;
  for (int seed = 0; seed < 8; ++seed) {
    const Outcome it = runs(R"(<leaf path="*" result="success" finish="full" ticks="2..9"/>)",
                            std::to_string(seed));
    INFO(it.err);
    CHECK(it.code == 0);
    outcomes.insert(it.out);
    CHECK(runs(R"(<leaf path="*" result="failure"/>)", std::to_string(seed)).code == 1);
  }
  CHECK(outcomes.size() > 1);
  CHECK(runs(R"(<leaf of="Lft"/>)", "1").code == 2);
}

TEST_CASE("a run that the script ends names the script's limit") {
  const TemporaryDirectory directory;
  const auto run = [&](std::vector<std::string> more) {
    const std::string tree = directory.file(
        "t.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"T\"><Hold/></BehaviorTree></root>");
    std::vector<std::string> words{
        "run",     tree,      "--leaves", directory.file("s.leaves", "@ticks 3\nT/Hold = R\n"),
        "--clock", "virtual", "--view",   "none"};
    words.insert(words.end(), more.begin(), more.end());
    return run_lockstep(words);
  };
  CHECK(contains(run({}).out, "the tick limit (@ticks of " + directory.path("s.leaves") +
                                  ") was reached after 3 ticks"));
  CHECK(contains(run({"--max-ticks", "2"}).out, "the tick limit (--max-ticks) was reached"));
}

TEST_CASE("a file of scenarios is no tree, and the command for it is named") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a.test.xml", "<scenarios tree=\"a.xml\"/>");
  for (const char* const command : {"verify", "run"}) {
    const Outcome refused = run_lockstep({command, file});
    CHECK(refused.code == 3);
    CHECK(contains(refused.err, "the first element must be 'root', not 'scenarios'"));
    CHECK(contains(refused.err, "`lockstep test` reads it"));
  }
}

TEST_CASE("a script of another tree is refused") {
  const TemporaryDirectory directory;
  const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml";
  const auto played = [&](const std::string& text) {
    return run_lockstep({"run", tree, "--leaves", directory.file("s.leaves", text), "--clock",
                         "virtual", "--view", "none"});
  };
  const Outcome other = played("OpenDoor/open/handl = S\n");
  CHECK(other.code == 2);
  CHECK(contains(other.err, "the tree has no leaf 'OpenDoor/open/handl'"));
  CHECK(played("OpenDoor\n").code == 2);
  const Outcome cut = played("@cut 1 continue OpenDoor/open/handl\n");
  CHECK(cut.code == 2);
  CHECK(contains(cut.err, "s.leaves:1:1: error: the tree has no leaf 'OpenDoor/open/handl'"));
}
