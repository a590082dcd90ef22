// A recording as a scenario: its leaves do what they did, so that the run is the same again.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

struct RecordedRun {
  std::string nodes;   // of the tree
  std::string leaves;  // NAME.leaves or a leaf file; "": those of plugins
  std::string name = "t.leaves.xml";
  std::string root = R"(lockstep="1")";
  std::string models = "";
};

const std::string kLooks =
    R"(<TreeNodesModel><Action ID="Look"><output_port name="found" type="bool"/></Action>
</TreeNodesModel>)";

// The scenario that is made of the run, if the run is the same when it is played.
std::string scenario_of(const RecordedRun& it, int seed = 0) {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml", "<root " + it.root +
                                  R"(><plugin name="motion"/><plugin name="fetch"/>
<BehaviorTree ID="T">)" + it.nodes +
                                  "</BehaviorTree>" + it.models + "</root>");
  const std::string run = directory.path("run.jsonl"), file = directory.path("t.test.xml");
  std::vector<std::string> command = {
      "run",         tree,     "--rate",   "10",     "--clock",
      "virtual",     "--view", "none",     "--seed", std::to_string(seed),
      "--max-ticks", "60",     "--record", run};
  if (!it.leaves.empty()) {
    command.insert(command.end(), {"--leaves", directory.file(it.name, it.leaves)});
  }
  const Outcome ran = run_lockstep(command);
  INFO(ran.err);
  REQUIRE((ran.code < 2 || ran.code == 5));
  const Outcome made = run_lockstep({"log", "scenario", run, "--save", file});
  INFO(made.err);
  REQUIRE(made.code == 0);
  const std::string text = read_file(file);
  std::string same = text;
  same.replace(same.find("<scenario name"), 9, fmt::format("<scenario seed=\"{}\"", seed));
  same.insert(same.find("<expect"), R"(<expect same-as="run.jsonl" tolerance="0.000001"/>)");
  static_cast<void>(directory.file("t.test.xml", same));
  const Outcome played = run_lockstep({"test", file, "--out", directory.path("failed")});
  INFO(it.nodes << "\nseed " << seed << '\n' << read_file(run) << same << played.out << played.err);
  CHECK(played.code == 0);
  return text;
}

}  // namespace

TEST_CASE("a leaf that moves and is then held does so in the scenario of its recording") {
  const std::string text = scenario_of({R"(<ParallelAbsolute barriers="0.5;1">
<Advance name="arm" step="0.1"/><Advance name="base" step="0.375"/></ParallelAbsolute>)",
                                        ""});
  CHECK(contains(text, R"(base" does="R0.375 R0.75 S"/>)"));
}

TEST_CASE("a leaf that moves and is held in one period has its drift while it is held") {
  const auto words = [](const std::string& leaf) {
    return scenario_of({R"(<ParallelRelative name="both" delta="0"><Advance name="arm"/>
<AsyncSequence name="prep"><AlwaysSuccess/><Advance name="base"/></AsyncSequence>
</ParallelRelative>)",
                        "@rate 10\nT/both/arm = " + leaf + "\nT/both/prep/base = R0.2 R0.9 S\n",
                        "t.leaves", R"(BTCPP_format="4")"});
  };
  for (const std::string leaf : {"R0.9 ~0.3 R1 S", "R0.9 R1 S"})
    CHECK(contains(words(leaf), "/arm\" does=\"" + leaf + "\"/>"));
}

TEST_CASE(
    "a leaf that an ancestor has ended in its tick has the result that follows from the others") {
  const auto script = [](const std::string& text) { return "@rate 10\n@ticks 5\n" + text; };
  const std::string went_on = scenario_of(
      {R"(<Parallel><Sequence><BatteryAbove name="c"/><Advance name="x"/></Sequence>
<Advance name="y"/></Parallel>)",
       script("T/Parallel/Sequence/c = S\nT/Parallel/Sequence/x = R0.1\nT/Parallel/y = R0.1 F\n"),
       "t.leaves"});
  CHECK(contains(went_on, R"(/c" does="S*2"/>)"));
  CHECK(contains(went_on, R"(/y" does="R0.1 F"/>)"));
  const std::string chosen = scenario_of(
      {R"(<Parallel><Fallback><Advance name="a"/><IfThenElse><BatteryAbove name="c"/><Advance name="x"/>
<Advance name="z"/></IfThenElse></Fallback><Advance name="y"/></Parallel>)",
       script("T/Parallel/Fallback/a = F\nT/Parallel/Fallback/IfThenElse/c = F\n"
              "T/Parallel/Fallback/IfThenElse/z = R0.1\nT/Parallel/y = F\n"),
       "t.leaves"});
  CHECK(contains(chosen, R"(/a" does="F"/>)"));
  CHECK(contains(chosen, R"(/c" does="F"/>)"));
  const std::string skipped =
      scenario_of({R"(<Parallel><WhileDoElse><Advance name="a"/><BatteryAbove name="c"/>
<Wait seconds="1" skip_if="true"/></WhileDoElse><Advance name="y"/></Parallel>)",
                   script("T/Parallel/WhileDoElse/a = F\nT/Parallel/y = R0.1 S\n"), "t.leaves"});
  CHECK(contains(skipped, R"(/a" does="F*2"/>)"));
  const std::string never_runs = scenario_of(
      {R"(<Parallel><Inverter><BatteryAbove name="c"/></Inverter><Fallback><BatteryAbove name="d"/>
<Advance name="x"/></Fallback><Advance name="y"/></Parallel>)",
       script("T/Parallel/Inverter/c = F\nT/Parallel/Fallback/d = S\nT/Parallel/y = R0.1 F\n"),
       "t.leaves"});
  CHECK_FALSE(contains(never_runs, R"(c" does="R)"));
}

TEST_CASE("what the tree itself gives an entry is not in the scenario of a recording") {
  const std::string text =
      scenario_of({.nodes = R"(<SubTree ID="S" name="s" limit="1"/></BehaviorTree>
<BehaviorTree ID="S"><Check code="limit == 1"/>)",
                   .leaves = "",
                   .root = R"(lockstep="1" main_tree_to_execute="T")"});
  CHECK_FALSE(contains(text, "<set"));
}

TEST_CASE("a leaf that puts an entry back writes it in the scenario") {
  const std::string nodes =
      R"(<Repeat times="3"><Sequence memory="true"><Script code="found := false"/>
<Action ID="Look" found="{found}"/><Check code="found"/></Sequence></Repeat>)";
  const std::string text = scenario_of(
      {nodes, "@rate 10\nT/Repeat/Sequence/Look = S[found=true] S[found=true] S[found=true]\n",
       "t.leaves", R"(lockstep="1")", kLooks});
  CHECK(contains(text, R"(does="S[found=true]*3"/>)"));
}

TEST_CASE("only what counts a time is said to take a tick more on the wall clock") {
  const TemporaryDirectory directory;
  const auto notes = [&](const std::string& node) {
    const std::string tree =
        directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="T"><Sequence memory="true">
<Script code="n := 0"/>)" + node + "</Sequence></BehaviorTree></root>");
    const std::string run = directory.path("run.jsonl");
    REQUIRE(run_lockstep({"run", tree, "--rate", "200", "--view", "none", "--record", run}).code ==
            0);
    return run_lockstep({"log", "scenario", run}).err;
  };
  const std::string more = "may take a tick more than here";
  CHECK(contains(notes(R"(<Wait seconds="0.01"/>)"), more));
  CHECK(contains(notes(R"(<WaitUntil code="n == 0" timeout="1"/>)"), more));
  CHECK(notes(R"(<WaitUntil code="n == 0"/>)").empty());
}

TEST_CASE("a start value is no write of a leaf in the scenario") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="T">
<Action ID="Look" found="{found}"/></BehaviorTree>)" + kLooks +
                                                       "</root>");
  const std::string run = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--leaves",
                        directory.file("t.leaves", "@rate 10\nT/Look = R0 S\n"), "--set",
                        "found=true", "--clock", "virtual", "--view", "none", "--record", run})
              .code == 0);
  const std::string text = run_lockstep({"log", "scenario", run}).out;
  CHECK(contains(text, R"(<set key="found" value="true" tick="0"/>)"));
  CHECK(contains(text, R"(does="R0 S"/>)"));
  // The recording has 5 for the text 5.0.
  const std::string far = directory.file("far.xml", R"(<root lockstep="1"><BehaviorTree ID="T">
<Action ID="Look" far="{far}"/></BehaviorTree><TreeNodesModel><Action ID="Look">
<output_port name="far" type="double"/></Action></TreeNodesModel></root>)");
  REQUIRE(run_lockstep({"run", far, "--leaves", directory.path("t.leaves"), "--set", "far=5.0",
                        "--clock", "virtual", "--view", "none", "--record", run})
              .code == 0);
  CHECK(contains(run_lockstep({"log", "scenario", run}).out, R"(does="R0 S"/>)"));
}

TEST_CASE("a leaf does not write what is no value of its port in the scenario") {
  const std::string text =
      scenario_of({R"(<Sequence><Script code="found := 'x'"/><Action ID="Look" found="{found}"/>
</Sequence>)",
                   "@rate 10\nT/Sequence/Look = S\n", "t.leaves", R"(BTCPP_format="4")", kLooks});
  CHECK(!contains(text, "found="));
}

TEST_CASE("a fault that has ended the run is one of its leaf in the scenario") {
  const std::string text =
      scenario_of({R"(<Sequence memory="true"><Advance name="x"/><Advance name="y"/></Sequence>)",
                   "@rate 10\n@ticks 3\nT/Sequence/x = S\nT/Sequence/y = R0.1 X\n", "t.leaves"});
  CHECK(contains(text, R"(/y" does="R0.1 X"/>)"));
}

TEST_CASE("a fault of a leaf that has scripts is one of the leaf, and one of its script is not") {
  // What the scenario does in the row of the leaf.
  const auto does = [](const std::string& script, const std::string& words, bool is_btcpp = false) {
    const std::string nodes =
        R"(<Script code="n := 0"/><Advance name="a" step="0.5" )" + script + "/></Sequence>";
    const std::string text =
        is_btcpp ? scenario_of({"<Sequence>" + nodes, "T/Sequence/a = " + words + "\n", "t.leaves",
                                R"(BTCPP_format="4")"})
                 : scenario_of({R"(<Sequence memory="true">)" + nodes,
                                "T/Sequence/a = " + words + "\n", "t.leaves"});
    const auto at = text.find("does=\"");
    return at == text.npos ? "" : text.substr(at + 6, text.find('"', at + 6) - at - 6);
  };
  for (const std::string script :
       {R"(on_success="n := 1")", R"(on_failure="n := 1")", R"(on_end="n := 1")",
        R"(on_halt="n := 1")", R"(skip_if="n == 1")", R"(while="n == 0")"}) {
    INFO(script);
    CHECK(does(script, "R0.5 X") == "R0.5 X");
    CHECK(does(script, "X") == "X");
  }
  CHECK(does(R"(_onSuccess="n := 1")", "R0.5 X", true) == "R0.5 X");
  CHECK(does(R"(_skipIf="n == 1")", "X", true) == "X");
  CHECK(does(R"(on_success="n := 1 / n")", "R0.5 S") == "R0.5 S");
  CHECK(does(R"(on_failure="n := 1 / n")", "R0.5 F") == "R0.5 F");
  CHECK(does(R"(on_end="n := 1 / n")", "R0.5 S") == "R0.5 S");
  CHECK(does(R"(skip_if="n := 1 / n; true")", "R0.5 S").empty());
  CHECK(does(R"(while="n := 1 / n; true")", "R0.5 S").empty());
}

TEST_CASE("a leaf that ran before the fault of its on_halt does so in the scenario") {
  const auto words = [](const std::string& hook, const std::string& other) {
    return scenario_of({R"(<Sequence memory="true"><Script code="n := 0"/><Parallel>
<Advance name="a" step="0.125" )" +
                            hook + "/>" + other + "</Parallel></Sequence>",
                        ""});
  };
  const std::string halt = R"(on_halt="n := 1 / 0")";
  CHECK(contains(words(halt, "<AlwaysFailure/>"), R"(/a" does="R0.125"/>)"));
  const std::string later = R"(<Sequence memory="true"><Wait seconds="0.2"/>)";
  CHECK(contains(words(halt, later + "<AlwaysFailure/></Sequence>"),
                 R"(/a" does="R0.125 R0.25*2"/>)"));
  // Its own script halts it, before its tick.
  CHECK(contains(words(halt + R"( while="n == 0")",
                       later + R"(<Script code="n = 1"/><Wait seconds="1"/></Sequence>)"),
                 R"(/a" does="R0.125 R0.25 R0.375"/>)"));
}

TEST_CASE("a result that a script of a leaf gives is no word of the leaf") {
  const auto words = [](const std::string& hook, const std::string& step) {
    return scenario_of(
        {R"(<Sequence memory="true"><Script code="n := 0"/><Repeat times="2">
<ForceSuccess><Advance name="a" step=")" +
             step + "\" " + hook +
             R"( on_success="n := 1" on_failure="n := 1"/></ForceSuccess></Repeat></Sequence>)",
         ""});
  };
  CHECK(contains(words(R"(failure_if="n == 0")", "0.5"), R"(/a" does="R0.5 S"/>)"));
  CHECK(contains(words(R"(success_if="n == 0")", "0.5"), R"(/a" does="R0.5 S"/>)"));
  CHECK(contains(words(R"(skip_if="n == 1")", "0.5"), R"(/a" does="R0.5 S"/>)"));
  CHECK(contains(words(R"(while="n == 0")", "0.5"), R"(/a" does="R0.5 S"/>)"));
}

TEST_CASE("what a scenario does not have of its recording is said in it and on stderr") {
  const TemporaryDirectory directory;
  const std::string run = directory.path("run.jsonl");
  const auto made = [&](const std::string& nodes, std::vector<std::string> more) {
    const std::string tree = directory.file(
        "t.xml", R"(<root lockstep="1"><plugin name="motion"/><BehaviorTree ID="T">)" + nodes +
                     R"(</BehaviorTree><TreeNodesModel><Action ID="Look"><output_port name="seen"
type="int"/></Action></TreeNodesModel></root>)");
    more.insert(more.begin(), {"run", tree, "--mock", "--clock", "virtual", "--rate", "1", "--view",
                               "none", "--record", run});
    if (contains(nodes, "Look")) more.insert(more.end(), {"--mock-output", "seen=3"});
    const Outcome ran = run_lockstep(more);
    INFO(ran.err);
    REQUIRE((ran.code < 2 || ran.code == 5));
    return run_lockstep({"log", "scenario", run});
  };
  const std::string after = "a script wrote 'seen' in tick 1 after 'T/Sequence/look'";
  for (const std::string hook : {R"(on_success="seen := 4")", R"(on_end="seen := 4")", ""}) {
    const Outcome it = made(
        "<Sequence memory=\"true\"><Action ID=\"Look\" name=\"look\" seen=\"{seen}\" " + hook +
            "/><Script code=\"n := 1" + (hook.empty() ? "; seen := n" : "") + "\"/></Sequence>",
        {});
    INFO(hook << '\n' << it.out << it.err);
    CHECK(contains(it.err, after));
    CHECK(contains(it.out, after));
    CHECK(!contains(it.out, "seen="));
  }
  // A script of the leaf, or the leaf itself.
  const Outcome decided = made(R"(<ForceSuccess><AlwaysFailure name="a"/></ForceSuccess>)", {});
  CHECK(decided.err.empty());
  const Outcome unknown = made(
      R"(<Fallback><Action ID="Look" name="look" seen="{seen}" failure_if="true"/><Script code="n := seen"/></Fallback>)",
      {"--set", "seen=1"});
  INFO(unknown.out << unknown.err);
  const std::string may_be = "the failure of 'T/Fallback/look' in tick 0 may be that of its script";
  CHECK(contains(unknown.err, may_be));
  CHECK(contains(unknown.err, "add the step F"));
  CHECK(contains(unknown.out, may_be));
  // The script puts back the value that the entry had.
  const Outcome taken = made(R"(<Sequence memory="true"><Script code="seen := 0"/>
<Wait seconds="1"/><Action ID="Look" name="look" seen="{seen}"/><Check code="seen == 3"/>
<Script code="seen = 0"/></Sequence>)",
                             {});
  INFO(taken.err);
  CHECK(contains(taken.err, "a script wrote 'seen' in tick "));
  CHECK(contains(taken.err, "and it has the value that it had"));
  const Outcome kept = made(R"(<Sequence memory="true"><Action ID="Look" name="look" seen="{seen}"
on_failure="seen := 4"/><Script code="n := seen"/></Sequence>)",
                            {});
  CHECK(kept.err.empty());
  CHECK(contains(kept.out, "3"));
  const Outcome faulty = made(
      R"(<ForceSuccess><Advance name="a" step="0.5"/></ForceSuccess>)",
      {"--on-fault", "fail", "--leaves", directory.file("t.leaves.xml", R"(<leaves lockstep="1">
<leaf path="*/a" result="fault"/></leaves>)")});
  CHECK(contains(faulty.err, "as with '--on-fault fail'"));
  CHECK(contains(faulty.out, R"(a" does="X"/>)"));
  // The result before the fault of a script for both, and a fault after the last tick.
  const Outcome ended = made(R"(<Advance name="a" step="0.5" on_end="n := 1 / 0"/>)", {});
  CHECK(contains(ended.err, "'T/a' has succeeded or failed in tick 1, before the fault"));
  const Outcome halted =
      made(R"(<Advance name="a" step="0.1" on_halt="n := 1 / 0"/>)", {"--max-ticks", "3"});
  CHECK(contains(halted.err, "'T/a' could not be halted after the last tick"));
  CHECK(contains(halted.out, R"(/a" does="R0.1 R0.2*2"/>)"));
}

TEST_CASE("a scenario sets an entry as the monitor does, and says what the entry cannot hold") {
  const TemporaryDirectory directory;
  static_cast<void>(
      directory.file("t.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence>
<Script code="k := 1"/><Sleep msec="300"/><Script code="j := k + 1"/>
<ScriptCondition code="j == 3.5"/></Sequence></BehaviorTree></root>)"));
  const auto played = [&](const std::string& sets) {
    return run_lockstep(
        {"test", directory.file("t.test.xml", R"(<scenarios lockstep="1" tree="t.xml">
<scenario name="x">)" + sets + R"(<expect result="success"/></scenario></scenarios>)")});
  };
  const Outcome twice =
      played(R"(<set key="k" value="7" tick="1"/><set key="k" value="2.5" tick="2"/>)");
  INFO(twice.out << twice.err);
  CHECK(twice.code == 0);
  // A port declares a double, and a script has made a whole number of it.
  static_cast<void>(directory.file("t.xml", R"(<root BTCPP_format="4"><plugin name="motion"/>
<BehaviorTree ID="M"><Sequence><Script code="k := 1"/><Sleep msec="200"/><Advance step="{k}"/>
</Sequence></BehaviorTree></root>)"));
  CHECK(contains(played(R"(<set key="k" value="0.5" tick="1"/>)").out,
                 "in tick 1, 'k' cannot be set to 0.5: it is 1"));
}

TEST_CASE("a halt that writes an entry after a leaf is said in the scenario") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="T">
<Sequence memory="true"><Script code="k := 0"/><Parallel name="p"><Go name="a" on_halt="k += 1"/>
<Go name="b" num="{k}"/><Go name="c"/></Parallel></Sequence></BehaviorTree><TreeNodesModel>
<Action ID="Go"><output_port name="num" type="int"/></Action></TreeNodesModel></root>)");
  const std::string leaves = directory.file(
      "t.leaves",
      "@rate 10\nT/Sequence/p/a = R\nT/Sequence/p/b = R R[num=2]\nT/Sequence/p/c = R F\n");
  const std::string run = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--leaves", leaves, "--clock", "virtual", "--view", "none",
                        "--record", run})
              .code == 1);
  CHECK(contains(run_lockstep({"log", "scenario", run}).err,
                 "'k' may have been written several times in tick 1: only its last value is "
                 "recorded, and 'T/Sequence/p/b' writes that"));
}

TEST_CASE("a scenario has no text that XML does not have, and is added to the scenarios only") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="T">
<Script code="n := m"/></BehaviorTree></root>)");
  const std::string run = directory.path("run.jsonl"), odd = directory.path("r\xe9.jsonl");
  const auto record = [&](const std::string& value, const std::string& to) {
    REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--set",
                          "m=" + value, "--record", to})
                .code == 0);
  };
  record("a", run);
  record("a", odd);
  const std::string comment = "<!-- before: <scenarios>\n</scenarios> -->\n";
  const std::string file = directory.file("t.test.xml", R"(<scenarios lockstep="1" tree="t.xml">
<scenario name="mine"><set key="m" value="a"/><expect result="success"/></scenario></scenarios>
)" + comment);
  CHECK(run_lockstep({"log", "scenario", odd, "--save", file}).code == 0);
  CHECK(run_lockstep({"log", "scenario", run, "--save", file, "--name", "x\x1b"}).code == 0);
  record("\x1b", run);
  const Outcome left_out = run_lockstep({"log", "scenario", run, "--save", file, "--name", "z"});
  CHECK(left_out.code == 0);
  CHECK(contains(left_out.err,
                 "note: the value of 'm' in tick 0 is not in the scenario: control "
                 "character \\x1B in the text"));
  const Outcome played = run_lockstep({"test", file});
  INFO(read_file(file) << played.out << played.err);
  CHECK(contains(played.out, "as in r\\xE9.jsonl"));
  CHECK(contains(played.out, "x\\x1B"));
  CHECK(contains(played.out, "4 scenarios: 3 passed, 1 invalid"));  // 'z' lacks a value
  CHECK(read_file(file).ends_with(comment));
  // The name of the tree file, too.
  const std::string named = directory.path("t\xe9.xml"), other = directory.path("u.test.xml");
  std::filesystem::copy(tree, named);
  record("a", run);
  for (const bool is_saved : {false, true}) {
    std::vector<std::string> command{"log", "scenario", run, named};
    if (is_saved) command.insert(command.end(), {"--save", other});
    const Outcome refused = run_lockstep(command);
    CHECK(refused.code == 2);
    CHECK(contains(refused.err, "a scenario cannot have this text: byte \\xE9 is not UTF-8"));
  }
  CHECK(!std::filesystem::exists(other));
}

TEST_CASE("a value that the recording does not have is named in the scenario and on stderr") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="T">
<Sequence memory="true"><Action ID="Look" name="look" seen="{seen}" size="{size}"/>
<Check code="size == 3"/></Sequence></BehaviorTree><TreeNodesModel>
<Action ID="Look"><output_port name="seen" type="string"/><output_port name="size" type="int"/>
</Action></TreeNodesModel></root>)");
  const std::string run = directory.path("run.jsonl");
  const auto notes = [&](const std::string& seen, const std::string& entries) {
    const Outcome ran =
        run_lockstep({"run", tree, "--mock", "--clock", "virtual", "--rate", "1", "--view", "none",
                      "--record", run, "--mock-output", "seen=" + seen, "--mock-output", "size=3",
                      "--record-entries", entries});
    INFO(ran.err);
    REQUIRE(ran.code == 0);
    const Outcome made = run_lockstep({"log", "scenario", run});
    INFO(made.err);
    CHECK(made.code == 0);
    // Both have the same notes.
    for (const std::string& line : lines(made.err)) {
      const auto begin = line.find("note: ");
      if (begin != line.npos) CHECK(contains(made.out, line.substr(begin + 6, 20)));
    }
    return made.err;
  };
  const std::string long_text(300, 'x');
  CHECK(notes("short", "all").empty());
  const std::string too_long =
      "what 'T/Sequence/look' wrote to 'seen' in tick 1 is not recorded: the value has more than "
      "256 bytes";
  CHECK(contains(notes(long_text, "all"), too_long));
  const std::string lacks = "the recording does not have the values of ";
  CHECK(contains(notes("short", "none"), lacks + "'seen', 'size': what"));
  CHECK(contains(notes("short", "size"), lacks + "'seen': what"));
  // Nothing in the tree gives it a value.
  const std::string set = directory.file("set.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="T">
<ScriptCondition code="k == 1"/></BehaviorTree></root>)");
  for (const std::string entries : {"all", "none"}) {
    REQUIRE(run_lockstep({"run", set, "--clock", "virtual", "--view", "none", "--set", "k=1",
                          "--record", run, "--record-entries", entries})
                .code == 0);
    const Outcome made = run_lockstep({"log", "scenario", run});
    CHECK(contains(made.err, lacks + "'k': what") == (entries == "none"));
  }
  // A script writes it, from a start value.
  const std::string counts = directory.file("counts.xml", R"(<root lockstep="1">
<BehaviorTree ID="T"><Sequence><Script code="n := n + 1"/><Script code="m := m + 1"/></Sequence>
</BehaviorTree></root>)");
  REQUIRE(run_lockstep({"run", counts, "--clock", "virtual", "--view", "none", "--set", "n=7",
                        "--set", "m=3", "--record", run, "--record-entries", "m"})
              .code == 0);
  CHECK(contains(run_lockstep({"log", "scenario", run}).err, lacks + "'n': what"));
}

TEST_CASE(
    "a value that another leaf, or the same one, may have written later in the tick is named") {
  const TemporaryDirectory directory;
  const std::string run = directory.path("run.jsonl");
  const auto note = [&](const std::string& root, const std::string& nodes) {
    const std::string tree = directory.file(
        "t.xml", "<root " + root + "><BehaviorTree ID=\"T\">" + nodes + "</BehaviorTree></root>");
    std::vector<std::string> command{
        "run",      tree, "--mock",      "--clock",     "virtual",       "--view", "none",
        "--record", run,  "--mock-leaf", "A=success:0", "--mock-output", "A.o=x"};
    if (contains(nodes, "<B "))
      command.insert(command.end(), {"--mock-leaf", "B=success:0", "--mock-output", "B.o=y"});
    const Outcome ran = run_lockstep(command);
    INFO(ran.err);
    REQUIRE(ran.code < 2);
    return run_lockstep({"log", "scenario", run}).err;
  };
  const std::string often =
      "note: 'e' may have been written several times in tick 0: only its last ";
  CHECK(contains(
      note(R"(lockstep="1")", R"(<Sequence memory="true"><A o="{e}"/><Check code="e == 'x'"/>
<B o="{e}"/></Sequence>)"),
      often + "value is recorded, and 'T/Sequence/A' writes that"));
  CHECK(contains(
      note(R"(BTCPP_format="4")",
           R"(<Sequence><Script code="n := 0"/><RetryUntilSuccessful num_attempts="4"><Sequence>
<A o="{e}"/><Script code="n += 1"/><ScriptCondition code="n == 3"/></Sequence></RetryUntilSuccessful></Sequence>)"),
      often));
  CHECK(!contains(
      note(R"(lockstep="1")", R"(<Sequence memory="true"><A o="{e}"/><Check code="e == 'x'"/>
<B o="{f}"/></Sequence>)"),
      "several times"));
  // The value of a script that has run before it, or the text '0' of the leaf.
  const auto zero = [&](const std::string& value) {
    const std::string tree = directory.file(
        "t.xml",
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><Sequence><Script code=\"e := 0\"/>"
        "<A o=\"{e}\"/></Sequence></BehaviorTree></root>");
    run_lockstep({"run", tree, "--mock", "--clock", "virtual", "--view", "none", "--record", run,
                  "--mock-leaf", "A=success:0", "--mock-output", "A.o=" + value});
    return run_lockstep({"log", "scenario", run}).err;
  };
  CHECK(contains(zero("0"), often + "value is recorded, and 'T/Sequence/A' writes that"));
  CHECK(!contains(zero("far"), often));
}

TEST_CASE("the scenario of a recording has rows for leaves only, and outputs only as outputs") {
  CHECK(!contains(
      scenario_of({"<Sequence memory=\"true\"><RoundRobin><AlwaysSuccess/></RoundRobin></Sequence>",
                   "", "", R"(lockstep="1"><plugin name="nav"/)"}),
      "RoundRobin"));
  // The plugin is not given when the scenario is made.
  const TemporaryDirectory directory;
  const std::string run = directory.path("run.jsonl"), file = directory.path("t.test.xml");
  const std::string tree =
      directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="T"><Parallel>
<Advance name="a" step="0.25" actual="{x}"/><Advance name="b" step="0.1" least_pace="{x}"/></Parallel></BehaviorTree></root>)");
  REQUIRE(run_lockstep({"run", tree, "--plugin", "motion", "--clock", "virtual", "--view", "none",
                        "--record", run})
              .code == 0);
  REQUIRE(run_lockstep({"log", "scenario", run, "--save", file}).code == 0);
  const Outcome played = run_lockstep({"test", file, "--plugin", "motion"});
  INFO(read_file(file) << played.out << played.err);
  CHECK(played.code == 0);
}

TEST_CASE("a text with ${ is itself in the scenario of a recording") {
  const TemporaryDirectory directory;
  const std::string run = directory.path("run.jsonl"), file = directory.path("t.test.xml");
  const std::string tree =
      directory.file("t.xml", R"(<root lockstep="1"><arg name="m" default="$${x} $$${y}"/>
<BehaviorTree ID="T"><Sequence memory="true"><Script code="s := '${m}'"/><A o="{e}"/><Check code="e == s"/></Sequence></BehaviorTree></root>)");
  REQUIRE(
      run_lockstep({"run", tree, "--mock", "--clock", "virtual", "--view", "none", "--mock-leaf",
                    "A=success:0", "--mock-output", "A.o=${x} $${y}", "--record", run})
          .code == 0);
  REQUIRE(run_lockstep({"log", "scenario", run, "--save", file}).code == 0);
  const Outcome played = run_lockstep({"test", file});
  INFO(read_file(file) << played.out << played.err);
  CHECK(played.code == 0);
  CHECK(contains(read_file(file), "value=\"$${x} $$${y}\""));
}

TEST_CASE("a recording in parts, and one of the wall clock, are repeated") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml",
                                          R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="T"><Advance name="a" step="0.001"/></BehaviorTree></root>)");
  const std::string test = directory.file("t.test.xml", R"(<scenarios lockstep="1" tree="t.xml">
<scenario name="s" rate="1000"><leaf path="a" from="plugin"/><expect same-as="run.jsonl" tolerance="0.000001"/></scenario></scenarios>)");
  for (const std::string clock : {"virtual", "wall"}) {
    std::vector<std::string> command = {
        "run",  tree,     "--clock", clock,      "--rate",
        "1000", "--view", "none",    "--record", directory.path("run.jsonl")};
    if (clock == "virtual") command.insert(command.end(), {"--record-rotate", "20kB"});
    REQUIRE(run_lockstep(command).code == 0);
    const Outcome it = run_lockstep({"test", test, "--out", directory.path("failed")});
    INFO(clock << '\n' << it.out << it.err);
    CHECK(it.code == 0);
  }
}

TEST_CASE("an action that keeps its result gets no tick, and each round within a tick is one") {
  for (const std::string nodes :
       {R"(<Repeat num_cycles="2"><WhileDoElse><Advance name="a" step="0.5"/>
           <Advance name="b" step="0.4"/></WhileDoElse></Repeat>)",
        R"(<Repeat num_cycles="3"><Sequence><Advance name="a" step="0.5"/>
           <Advance name="b" step="0.4"/></Sequence></Repeat>)"}) {
    INFO(nodes);
    const TemporaryDirectory directory;
    const std::string file = directory.file(
        "t.xml", R"(<root BTCPP_format="4"><plugin name="motion"/><BehaviorTree ID="T">)" + nodes +
                     "</BehaviorTree></root>");
    const std::string run = directory.path("run.jsonl"), test = directory.path("t.test.xml");
    REQUIRE(run_lockstep({"run", file, "--clock", "virtual", "--rate", "10", "--view", "none",
                          "--record", run})
                .code == 0);
    REQUIRE(run_lockstep({"log", "scenario", run, "--save", test}).code == 0);
    const Outcome played = run_lockstep({"test", test, "--out", directory.path("failed")});
    INFO(read_file(test) << played.out);
    CHECK(played.code == 0);
    const std::string leaves = directory.file("t.leaves.xml", R"(<leaves lockstep="1">
        <leaf path="*/a" ticks="2"/><leaf path="*/b" ticks="3"/></leaves>)");
    const Outcome audited = run_lockstep({"log", "check", run, "--leaves", leaves});
    INFO(audited.out << audited.err);
    CHECK(audited.code == 0);
  }
}

TEST_CASE("the scenario of a recording is the run once more, whatever its leaves do by chance") {
  const std::string nodes[] = {
      R"(<ParallelAbsolute barriers="0.3;0.6"><Advance name="a"/><Advance name="b"/>
<Sequence memory="true"><Advance name="c"/><Advance name="d"/></Sequence></ParallelAbsolute>)",
      R"(<Repeat times="3"><ForceSuccess><Parallel success_count="1"><Advance name="a"/>
<ParallelAbsolute barriers="0.3;0.6"><Advance name="b"/><Advance name="c"/></ParallelAbsolute>
</Parallel></ForceSuccess></Repeat>)",
      R"(<Retry attempts="3"><ParallelRelative delta="0.2"><Advance name="a"/>
<Repeat times="2"><Advance name="b"/></Repeat></ParallelRelative></Retry>)",
      R"(<Parallel success_count="1"><ParallelAbsolute barriers="0.5"><Inverter><BatteryAbove/></Inverter>
<Fallback><BatteryAbove/><Advance name="a"/></Fallback></ParallelAbsolute>
<Sequence><BatteryAbove/><Advance name="b"/></Sequence></Parallel>)",
  };
  for (const std::string& it : nodes) {
    for (int seed = 0; seed < 12; ++seed) {
      const std::string held = seed % 3 == 0 ? "still" : seed % 3 == 1 ? "-1..1" : "-2..-1";
      scenario_of({it, fmt::format(R"(<leaves lockstep="1"><leaf of="Advance" ticks="1..7"
result="success;failure" progress="grid:10" step="0..3" held="{}"/></leaves>)",
                                   held)},
                  seed);
    }
  }
}

TEST_CASE("the scenario of a run with several moments in a tick has the progress in each of them") {
  const std::string for_other = R"(BTCPP_format="4")";
  // `x` is held in the second moment, at what its tick in the first one has led to.
  const std::string held = scenario_of(
      {R"(<ParallelRelative delta="0"><RetryUntilSuccessful num_attempts="3"><AlwaysFailure/>
</RetryUntilSuccessful><KeepRunningUntilFailure><Advance name="x"/></KeepRunningUntilFailure>
</ParallelRelative>)",
       "@rate 10\nT/ParallelRelative/KeepRunningUntilFailure/x = R0.6 R0.7\n", "t.leaves",
       for_other});
  CHECK(contains(held, R"(/x" does="R0.6"/>)"));
  // It begins again in the moment in which it has succeeded, so it ends the tick with 0.
  const std::string again = scenario_of(
      {R"(<Repeat num_cycles="2"><ParallelRelative delta="1"><Advance name="x"/></ParallelRelative>
</Repeat>)",
       "@rate 10\nT/Repeat/ParallelRelative/x = R0.3 S R0.1 S\n", "t.leaves", for_other});
  CHECK(contains(again, R"(/x" does="R0.3 S R0.1 S"/>)"));
  for (const char* nodes :
       {R"(<ParallelRelative delta="0.2"><RetryUntilSuccessful num_attempts="3"><BatteryAbove/>
</RetryUntilSuccessful><Inverter><Advance name="a"/></Inverter></ParallelRelative>)",
        R"(<Repeat num_cycles="4"><ParallelAbsolute barriers="0.3;0.6" failure_count="2">
<Advance name="a"/><KeepRunningUntilFailure><Advance name="b"/></KeepRunningUntilFailure>
<RetryUntilSuccessful num_attempts="2"><Advance name="c"/></RetryUntilSuccessful>
</ParallelAbsolute></Repeat>)",
        R"(<WhileDoElse><ParallelRelative delta="0.5" success_count="1"><Advance name="a"/>
</ParallelRelative><Repeat num_cycles="2"><ForceSuccess><Advance name="b"/></ForceSuccess></Repeat>
<ParallelRelative delta="1"><Advance name="c"/><BatteryAbove/></ParallelRelative></WhileDoElse>)"}) {
    for (int seed = 0; seed < 12; ++seed) {
      scenario_of({nodes, R"(<leaves lockstep="1"><leaf of="Advance" ticks="1..5"
result="success;failure" progress="grid:10" step="0..3"/></leaves>)",
                   "t.leaves.xml", for_other},
                  seed);
    }
  }
}

TEST_CASE("a leaf has its own progress in a scenario where something else was compared") {
  struct Row {
    std::string_view tree, leaves, does;
  };
  const Row rows[] = {
      // It has succeeded, so the barrier takes it for 1 when it begins again.
      {R"(<root lockstep="1"><barrier name="b" barriers="0.5"/><BehaviorTree ID="T"><Parallel>
<Repeat times="2"><SyncProgress barrier="b"><Action ID="A" name="a"/></SyncProgress></Repeat>
<SyncProgress barrier="b"><Action ID="A" name="c"/></SyncProgress>
<Sequence memory="true"><Wait seconds="0.2"/><WaitUntil code="progress(a) &gt;= 0.5" timeout="0.3"/>
</Sequence></Parallel></BehaviorTree></root>)",
       "T/Parallel/Repeat/SyncProgress/a = S R0.1 R0.2\nT/Parallel/SyncProgress/c = R0.1\n",
       R"(a" does="S R0.1 R0.2)"},
      // It succeeds in a later moment of its first tick.
      {R"(<root BTCPP_format="4"><BehaviorTree ID="T"><Sequence><Script code="y := 0"/>
<ParallelAbsolute barriers="0.9"><AsyncSequence><AlwaysSuccess/><AlwaysSuccess/><Sleep msec="500"/>
<ScriptCondition code="y == 1"/></AsyncSequence><Action ID="A" name="b" _onSuccess="y = 1"/>
</ParallelAbsolute></Sequence></BehaviorTree></root>)",
       "T/Sequence/ParallelAbsolute/b = R0 S\n", R"(b" does="R0 S")"},
  };
  for (const Row& row : rows) {
    const TemporaryDirectory directory;
    const std::string tree = directory.file("t.xml", std::string(row.tree));
    const std::string run = directory.path("run.jsonl"), file = directory.path("t.test.xml");
    const std::string leaves = directory.file("l.leaves", "@rate 10\n" + std::string(row.leaves));
    REQUIRE(run_lockstep({"run", tree, "--mock", "--leaves", leaves, "--clock", "virtual", "--view",
                          "none", "--record", run})
                .code < 2);
    REQUIRE(run_lockstep({"log", "scenario", run, "--save", file}).code == 0);
    const Outcome played = run_lockstep({"test", file, "--out", directory.path("failed")});
    INFO(read_file(run) << read_file(file) << played.out << played.err);
    CHECK(contains(read_file(file), std::string(row.does)));
    CHECK(played.code == 0);
  }
}

namespace {

struct Retold {
  std::string text, notes;  // the scenario, and what stderr has about it
  Outcome played;
};

// Of a recording of the wall clock that is written by hand: its lines after the header.
Retold retold(const std::string& nodes, const std::string& ticks,
              const std::string& after_cut = "") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="T">)" + nodes + "</BehaviorTree></root>");
  const std::string run = directory.path("run.jsonl"), file = directory.path("t.test.xml");
  REQUIRE(run_lockstep({"run", tree, "--rate", "10", "--clock", "virtual", "--view", "none",
                        "--max-ticks", "1", "--record", run})
              .code == 124);
  std::string header = lines(read_file(run)).front();
  header.replace(header.find("\"virtual\""), 9, "\"wall\"");
  static_cast<void>(directory.file("run.jsonl", header + '\n' + ticks));
  if (!after_cut.empty()) {
    header.insert(header.rfind('}'), R"(,"first_tick":5,"resumed_after_s":0.02)");
    static_cast<void>(directory.file("run.resumed-1.jsonl", header + '\n' + after_cut));
  }
  const Outcome made = run_lockstep({"log", "scenario", run, "--save", file, "--name", "s"});
  INFO(made.err);
  REQUIRE(made.code == 0);
  return {read_file(file), made.err,
          run_lockstep({"test", file, "--out", directory.path("failed")})};
}

}  // namespace

TEST_CASE("a fault of a leaf that did not wait for its tick is in its scenario") {
  const std::string both = R"(<ParallelAbsolute name="both" barriers="0.5"><Advance name="arm"/>
<Advance name="base"/></ParallelAbsolute>)";
  const std::string
      begin =
          R"({"tick":0,"time_s":0.0,"nodes":[[0,"running",0,1,0],[1,"running",0,1,0],[2,"running",0,1,0]],"limits":[[0,0.5]]}
)",
      end =
          R"({"end":{"result":"fault","reason":"fault","fault":"T/both/base: the brake is broken","ticks":3,"time_s":0.2,"overruns":0,"skipped":0}}
)";
  const Retold moving = retold(
      both,
      begin +
          R"({"tick":1,"time_s":0.1,"nodes":[[0,"running",0.1,1,0],[1,"running",0.1,1,0],[2,"running",0.2,1,0]]}
{"tick":2,"time_s":0.2,"nodes":[[0,"running",0.2,0,0],[1,"running",0.2,0,0],[2,"running",0.3,0,0]]}
)" + end);
  INFO(moving.text << moving.notes << moving.played.out);
  CHECK(contains(moving.text, R"(/base" does="R0.2 R0.3 X"/>)"));
  CHECK(moving.notes.empty());
  CHECK(moving.played.code == 0);
  const Retold held = retold(
      both,
      begin +
          R"({"tick":1,"time_s":0.1,"nodes":[[0,"running",0.1,1,0],[1,"running",0.1,1,0],[2,"running",0.5,0,1]]}
{"tick":2,"time_s":0.2,"nodes":[[0,"running",0.2,0,0],[1,"running",0.2,0,0],[2,"running",0.5,0,1]]}
)" + end);
  INFO(held.text << held.notes);
  CHECK(contains(held.text, R"(/base" does="R0.5 X"/>)"));
  const std::string note = "'T/both/base' had the fault in tick 2 while it was held";
  CHECK(contains(held.text, note));
  CHECK(contains(held.notes, note));
  // As with --on-fault fail. A leaf that is never held has a shorter note.
  const Retold failed = retold(
      both,
      begin +
          R"({"tick":1,"time_s":0.1,"nodes":[[0,"failure",0.1,1,0],[1,"idle",0.1,1,0],[2,"failure",0.5,1,0]],"faults":[[2,"the brake is broken"]]}
{"end":{"result":"failure","reason":"completed","ticks":2,"time_s":0.1,"overruns":0,"skipped":0}}
)");
  INFO(failed.notes);
  CHECK(contains(failed.notes, "ends with it, or with the next tick of a held leaf"));
}

TEST_CASE("the scenario of a run that skipped deadlines has its late ticks") {
  const std::string nodes = R"(<Sequence name="s" memory="true"><Wait seconds="1"/>
<Advance name="a" step="0.5"/></Sequence>)";
  // In which each tick comes, as the recording has it.
  const auto run = [&](const std::vector<double>& times, int skipped) {
    std::string text;
    for (std::size_t tick = 0; tick < times.size(); ++tick) {
      const std::string states =
          tick == 0                  ? R"([0,"running",0,1,0],[1,"running",0,1,0])"
          : tick + 1 == times.size() ? R"([0,"success",0.5,1,0],[2,"success",0.5,1,0])"
          : tick + 2 == times.size() ? R"([1,"success",1,1,0],[2,"running",0,1,0])"
                                     : "";
      text += fmt::format(R"({{"tick":{},"time_s":{},"nodes":[{}]}})", tick, times[tick], states) +
              '\n';
    }
    return retold(
        nodes,
        text +
            fmt::format(
                R"({{"end":{{"result":"success","reason":"completed","ticks":{},"time_s":{},"overruns":1,"skipped":{}}}}})",
                times.size(), times.back(), skipped) +
            '\n');
  };
  const Retold late = run({0.001, 0.101, 0.201, 0.301, 0.87, 0.901, 1.001, 1.101}, 4);
  INFO(late.text << late.played.out);
  CHECK(contains(late.text, R"(<late tick="3" by="0.5"/>)"));
  CHECK(late.played.code == 0);
  // Before its first tick. Then one that is late by less than a period.
  const Retold first = run({0.25, 0.301, 0.401, 0.599, 0.601, 0.701, 1.301, 1.401}, 7);
  INFO(first.text << first.played.out);
  CHECK(contains(first.text, "<late tick=\"5\" by=\"0.6\"/>\n    <leaf"));
  CHECK(first.played.code == 0);
  // As with --overrun catch-up.
  const Retold caught_up = run({0, 0.1, 0.37, 0.38, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.1}, 0);
  INFO(caught_up.text << caught_up.played.out);
  CHECK(!contains(caught_up.text, "<late"));
  CHECK(caught_up.played.code == 0);
  // The Wait began late within its tick, so it took a tick more than it does in the scenario.
  const Retold more = run({0.001, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.1, 1.2}, 0);
  INFO(more.text << more.played.out);
  CHECK(contains(more.text, R"(<expect result="success" ticks="12..13"/>)"));
  CHECK(contains(more.played.out, "ok    s  12 ticks"));
}

TEST_CASE("a run with late ticks is the same run in the scenario of its recording") {
  const TemporaryDirectory directory;
  static_cast<void>(directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="T"><Parallel><Wait seconds="0.8"/><Advance name="a"/>
<ParallelAbsolute barriers="0.5"><Advance name="b"/><Advance name="c"/></ParallelAbsolute>
</Parallel></BehaviorTree></root>)"));
  // It drifts while it is held, by a step in each period.
  std::string drifts = "R0.5";
  for (int step = 51; step < 60; ++step) drifts += fmt::format(" ~0.{}", step);
  for (const std::string rate : {"10", "30", "7"}) {
    const std::string played = directory.file("p.test.xml", R"(<scenarios lockstep="1" tree="t.xml">
<scenario name="p" rate=")" + rate + R"("><leaf path="a" from="plugin"/>
<leaf path="b" does=")" + drifts + R"( S"/><leaf path="c" does="R.1 R.2 R.3 R.4 R.45*3 R.5 S"/>
<late tick="2" by="0.25"/><late tick="3" by="0.31"/><expect same-as="run.jsonl"/></scenario></scenarios>)");
    REQUIRE(run_lockstep({"test", played, "--update"}).code == 0);
    const std::string file = directory.path("t.test.xml");
    std::filesystem::remove(file);
    REQUIRE(run_lockstep({"log", "scenario", directory.path("run.jsonl"), "--save", file}).code ==
            0);
    std::string text = read_file(file);
    text.insert(text.find("<expect"), R"(<expect same-as="run.jsonl" tolerance="1e-12"/>)");
    const Outcome again = run_lockstep({"test", directory.file("t.test.xml", text)});
    INFO(text << again.out << again.err);
    CHECK(contains(text, "<late tick=\"2\""));
    CHECK(again.code == 0);
  }
}

TEST_CASE("a leaf that completes in ticks that a recording has lost does so in its scenario") {
  const std::string nodes = R"(<Sequence name="s" memory="true"><Advance name="c"/>
<Parallel name="p"><Advance name="a"/><Advance name="b"/></Parallel></Sequence>)";
  const std::string
      before = R"({"tick":0,"time_s":0.0,"nodes":[[0,"running",0,1,0],[1,"running",0,1,0]]}
{"tick":1,"time_s":0.1,"nodes":[[1,"running",0.3,1,0]]}
)",
      lost = R"({"lost":{"ticks":3,"from":2}}
)",
      states =
          R"([0,"running",0.6,1,0],[1,"success",1,0,0],[2,"running",0.2,1,0],[3,"running",0.2,1,0],[4,"running",0.2,1,0])",
      after = R"({"tick":6,"time_s":0.6,"nodes":[[3,"success",0.4,1,0],[4,"running",0.4,1,0]]}
{"tick":7,"time_s":0.7,"nodes":[[0,"success",0.7,1,0],[2,"success",0.7,1,0],[4,"success",0.6,1,0]]}
)";
  const auto end = [](const std::string& more) {
    return R"({"end":{"result":"success","reason":"completed","ticks":8,"time_s":0.8,"overruns":0,"skipped":0)" +
           more + "}}\n";
  };
  const Retold gap = retold(nodes, before + lost + R"({"tick":5,"time_s":0.5,"nodes":[)" + states +
                                       "]}\n" + after + end(R"(,"lost":3)"));
  const Retold cut = retold(
      nodes, before,
      R"({"tick":5,"time_s":0.5,"nodes":[)" + states + R"(],"whole":[]})" + '\n' + after + end(""));
  for (const Retold& it : {gap, cut}) {
    INFO(it.text << it.notes << it.played.out << it.played.err);
    CHECK(contains(it.text, R"(/c" does="R0.3 R0.475 R0.65 R0.825 R1 S"/>)"));
    CHECK(contains(it.text, R"(<expect result="success"/>)"));
    const std::string note =
        "3 ticks are missing, from tick 2 on: what leaves did there is guessed";
    CHECK(contains(it.text, note));
    CHECK(contains(it.notes, "note: " + note));
    CHECK(!contains(it.notes, "error"));
    CHECK(it.played.code == 0);
    CHECK(contains(it.played.out, "8 ticks"));
  }
}

TEST_CASE(
    "a leaf that runs on through ticks that a recording has lost takes as many in its scenario") {
  const Retold it = retold(
      R"(<Parallel name="p"><Advance name="a"/><Advance name="b"/></Parallel>)",
      R"({"tick":0,"time_s":0.0,"nodes":[[0,"running",0,1,0],[1,"running",0,1,0],[2,"running",0,1,0]]}
{"lost":{"ticks":1,"from":1}}
{"tick":2,"time_s":0.2,"nodes":[[0,"running",0.25,1,0],[1,"running",0.25,1,0],[2,"success",1,0,0]]}
{"lost":{"ticks":2,"from":3}}
{"tick":5,"time_s":0.5,"nodes":[[0,"success",0.5,1,0],[1,"success",0.5,1,0]]}
{"end":{"result":"success","reason":"completed","ticks":6,"time_s":0.6,"overruns":0,"skipped":0,"lost":3}}
)");
  INFO(it.text << it.notes << it.played.out);
  CHECK(contains(it.text, R"(/a" does="R0.125 R0.25 R0.333333333333 R0.416666666667 R0.5 S"/>)"));
  CHECK(contains(it.notes, "3 ticks are missing in 2 places, from tick 1 on"));
  CHECK(contains(it.played.out, "6 ticks"));
}

TEST_CASE("what came from outside before the first tick after a cut is set in its scenario") {
  const auto sets = [](const std::string& value) {
    return retold(
               R"(<Sequence name="s" memory="true"><Script code="go := false"/>
<WaitUntil name="w" code="go == true"/><Script code="go = false"/></Sequence>)",
               R"({"tick":0,"time_s":0.0,"nodes":[[0,"running",0,1,0],[1,"success",0,1,0],[2,"running",0,1,0]],"entries":[[0,"false"]]}
{"lost":{"ticks":3,"from":1}}
{"tick":4,"time_s":0.4,"nodes":[]}
)",
               R"({"tick":5,"time_s":0.5,"nodes":[[0,"success",0.3,1,0],[1,"success",1,0,0],[2,"success",0,1,0],[3,"success",0,1,0]],)" +
                   value + R"(}
{"end":{"result":"success","reason":"completed","ticks":6,"time_s":0.5,"overruns":0,"skipped":0}}
)")
        .text;
  };
  CHECK(contains(
      sets(R"("entries":[[0,"false"]],"set":[0],"given":[[0,"true"]],"whole":[[0,"false"]])"),
      R"(<set key="go" value="true" tick="5"/>)"));
}
