// Scenarios and the other commands: counter-examples, leaf files, changes that nobody notices.
#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

constexpr auto kTwo = R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="Main"><Parallel name="both"><Advance name="left" step="0.25"/>
<Advance name="right" step="0.25"/></Parallel></BehaviorTree></root>)";

}  // namespace

TEST_CASE("a counter-example of verify becomes a scenario that fails until the tree is better") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", kTwo), file = directory.path("t.test.xml");
  const std::string property = "grip: never left.progress > 0.5 and right.progress < 0.5";
  const Outcome verified = run_lockstep(
      {"verify", tree, "--property", property, "--out", directory.path("found"), "--save", file});
  INFO(verified.out << verified.err);
  CHECK(verified.code == 1);
  const Outcome bad = run_lockstep({"test", file, "--out", directory.path("failed")});
  INFO(bad.out << bad.err);
  CHECK(bad.code == 1);
  CHECK(contains(bad.out, "'never left.progress > 0.5 and right.progress < 0.5' is violated"));
  // One after the other, the same leaves do not bring it about.
  static_cast<void>(directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="Main"><Sequence name="both" memory="true"><Advance name="right" step="0.25"/>
<Advance name="left" step="0.25"/></Sequence></BehaviorTree></root>)"));
  const Outcome good = run_lockstep({"test", file, "--out", directory.path("failed")});
  INFO(good.out << good.err);
  CHECK(good.code == 0);
}

namespace {

struct Saved {
  std::string_view finding, outside, tree, leaves, mended_outside, mended;
};

// clang-format off
const Saved kSaved[] = {
  {"trap", R"(<barrier name="coarse" barriers="0.5"/><barrier name="fine" barriers="0.25"/>)",
   R"(<Parallel><SyncProgress barrier="coarse"><SyncProgress barrier="fine"><Advance name="a" step="0.1"/></SyncProgress></SyncProgress>
      <SyncProgress barrier="coarse"><Sequence memory="true"><Advance name="b" step="0.1"/>
      <SyncProgress barrier="fine"><Advance name="c" step="0.1"/></SyncProgress></Sequence></SyncProgress></Parallel>)", "",
   R"(<barrier name="coarse" barriers="0.8"/><barrier name="fine" barriers="0.25"/>)", ""},
  // What helps in general is not allowed here: each leaf would succeed.
  {"trap", "", R"(<KeepRunningUntilFailure name="k"><Inverter name="i"><Advance name="a" step="0.1"/></Inverter></KeepRunningUntilFailure>)",
   R"(<fact name="open" changes="never"/><leaf path="*" fact="open"/>)",
   "", R"(<Retry name="k" attempts="5"><Inverter name="i"><Advance name="a" step="0.1"/></Inverter></Retry>)"},
  {"cycle", "", R"(<KeepRunningUntilFailure name="k"><Inverter name="i"><Advance name="a" step="0.1"/></Inverter></KeepRunningUntilFailure>)", "",
   "", R"(<Retry name="k" attempts="5"><Inverter name="i"><Advance name="a" step="0.1"/></Inverter></Retry>)"},
  {"fault/Main/Sequence/s", "",
   R"(<Sequence memory="true"><Advance name="a" step="0.1"/><Check name="s" code="n == 1"/><Script code="n := 1"/></Sequence>)", "",
   "", R"(<Sequence memory="true"><Advance name="a" step="0.1"/><Script code="n := 1"/><Check name="s" code="n == 1"/></Sequence>)"},
  {"starvation/Main/Parallel/Repeat#3/UseResources/c", R"(<resources name="hand" increment="0"/>)",
   R"(<Parallel><Repeat><UseResources pool="hand" resources="left"><Advance name="a" step="0.1"/></UseResources></Repeat>
      <Repeat><UseResources pool="hand" resources="left"><Advance name="b" step="0.1"/></UseResources></Repeat>
      <Repeat><UseResources pool="hand" resources="left"><Advance name="c" step="0.1"/></UseResources></Repeat></Parallel>)",
   R"(<tree ends="no"/><leaf path="*" result="success" ticks="1..2"/>)", R"(<resources name="hand" increment="1"/>)", ""},
};
// clang-format on

std::string file_of(std::string_view outside, std::string_view tree) {
  return R"(<root lockstep="1"><plugin name="motion"/>)" + std::string(outside) +
         R"(<BehaviorTree ID="Main">)" + std::string(tree) + "</BehaviorTree></root>";
}

}  // namespace

TEST_CASE("verify --save: what was found is a test that fails until the tree is mended") {
  for (const Saved& it : kSaved) {
    const TemporaryDirectory directory;
    const std::string tree = directory.file("t.xml", file_of(it.outside, it.tree));
    const std::string file = directory.path("t.test.xml");
    const std::string leaves = directory.file(
        "t.leaves.xml", "<leaves lockstep=\"1\">" + std::string(it.leaves) + "</leaves>");
    const Outcome verified =
        run_lockstep({"verify", tree, "--leaves", leaves, "--only", std::string(it.finding),
                      "--out", directory.path("found"), "--save", file});
    INFO(it.tree << '\n' << verified.out << verified.err);
    REQUIRE(verified.code == 1);
    INFO(read_file(file));
    const Outcome now = run_lockstep({"test", file, "--out", directory.path("failed")});
    INFO(now.out << now.err);
    CHECK(now.code == 1);
    CHECK(contains(now.out, "1 failed"));
    static_cast<void>(directory.file(
        "t.xml", file_of(it.mended_outside, it.mended.empty() ? it.tree : it.mended)));
    const Outcome mended = run_lockstep({"test", file, "--out", directory.path("failed")});
    INFO(mended.out << mended.err);
    CHECK(mended.code == 0);
  }
}

TEST_CASE("a scenario of a tree that --tree chose is about that tree") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1" main_tree_to_execute="A">
<plugin name="motion"/><BehaviorTree ID="A"><AlwaysSuccess/></BehaviorTree>
<BehaviorTree ID="B"><Advance name="b" step="0.5"/></BehaviorTree></root>)");
  const std::string run = directory.path("run.jsonl"), file = directory.path("t.test.xml");
  REQUIRE(run_lockstep(
              {"run", tree, "--tree", "B", "--clock", "virtual", "--view", "none", "--record", run})
              .code == 0);
  REQUIRE(run_lockstep({"log", "scenario", run, "--save", file}).code == 0);
  CHECK(run_lockstep({"verify", tree, "--tree", "B", "--property", "q: never b.failure", "--out",
                      directory.path("found"), "--save", file})
            .code == 1);
  const Outcome played = run_lockstep({"test", file, "--out", directory.path("failed")});
  INFO(read_file(file) << played.out << played.err);
  CHECK(contains(played.out, "2 scenarios: 1 passed, 1 failed"));
}

TEST_CASE("the option --save adds no scenario to those of another tree") {
  const TemporaryDirectory directory;
  const auto tree_of = [](const std::string& id, const std::string& around) {
    return "<root lockstep=\"1\" main_tree_to_execute=\"" + id +
           "\"><plugin name=\"motion\"/><BehaviorTree ID=\"" + id + "\"><" + around +
           "><Advance name=\"a\" step=\"0.5\"/></" + around +
           "></BehaviorTree><BehaviorTree ID=\"Other\"><AlwaysSuccess/></BehaviorTree></root>";
  };
  std::filesystem::create_directory(directory.path("sub"));
  const std::string one = directory.file("one.xml", tree_of("One", "ForceSuccess"));
  const std::string two = directory.file("sub/two.xml", tree_of("Two", "Inverter"));
  const std::string run = directory.path("run.jsonl"), file = directory.path("all.test.xml");
  const auto verify = [&](const std::string& tree, const std::string& name) {
    return run_lockstep({"verify", tree, "--mock", "--property", name + ": never a.ticked", "--out",
                         directory.path("found"), "--save", file});
  };
  REQUIRE(verify(one, "p").code == 1);
  const std::string before = read_file(file);
  const std::string other = "has scenarios of the tree 'one.xml', not of 'sub/two.xml'";
  const Outcome verified = verify(two, "q");
  CHECK(verified.code == 2);
  CHECK(contains(verified.err, other));
  REQUIRE(
      run_lockstep({"run", two, "--clock", "virtual", "--view", "none", "--record", run}).code ==
      1);
  const Outcome recorded = run_lockstep({"log", "scenario", run, "--save", file});
  CHECK(recorded.code == 2);
  CHECK(contains(recorded.err, other));
  CHECK(read_file(file) == before);
  // The same file by another name.
  CHECK(verify(directory.path("sub/../one.xml"), "r").code == 1);
  // Where the file names no tree, each scenario does.
  static_cast<void>(directory.file("all.test.xml", "<scenarios lockstep=\"1\">\n</scenarios>\n"));
  CHECK(verify(one, "p").code == 1);
  CHECK(verify(two, "q").code == 1);
  CHECK(run_lockstep({"log", "scenario", run, "--save", file}).code == 0);
  const Outcome played = run_lockstep({"test", file, "--out", directory.path("failed")});
  INFO(read_file(file) << played.out << played.err);
  CHECK(contains(played.out, "3 scenarios: 1 passed, 2 failed"));
  // Another BehaviorTree of the file.
  static_cast<void>(
      directory.file("all.test.xml",
                     "<scenarios lockstep=\"1\" tree=\"one.xml\" main=\"Other\">\n</scenarios>\n"));
  const Outcome of_main = verify(one, "p");
  CHECK(of_main.code == 2);
  CHECK(contains(of_main.err, "of the BehaviorTree 'Other', not of 'One'"));
}

TEST_CASE("the option --save of a tree that is no file is refused before the search") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="Main">
<Sequence><Action ID="A" name="a"/></Sequence></BehaviorTree></root>)");
  const std::string file = directory.path("t.test.xml");
  const Outcome verified =
      run({.arguments = {"-c",
                         "\"$0\" verify - --mock --property 'p: never a.ticked' --out \"$2\" "
                         "--save \"$3\" < \"$1\"",
                         LOCKSTEP_BINARY_DIR "/lockstep", tree, directory.path("found"), file},
           .program = "/bin/sh"});
  CHECK(verified.code == 2);
  CHECK(verified.out.empty());
  CHECK(contains(verified.err, "a scenario needs a file with its tree"));
  CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("a counter-example has the results of leaves beside those of scripts around them") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="Main">
<Sequence memory="true"><Script code="f := false"/><Action ID="A" name="a" failure_if="f"/></Sequence>
</BehaviorTree></root>)");
  const std::string file = directory.path("t.test.xml");
  const Outcome verified = run_lockstep({"verify", tree, "--mock", "--property", "never a.failure",
                                         "--out", directory.path("found"), "--save", file});
  INFO(verified.out << verified.err << read_file(file));
  CHECK(verified.code == 1);
  CHECK(run_lockstep({"test", file, "--out", directory.path("failed")}).code == 1);
}

TEST_CASE("a recording becomes a scenario in which scripts write what they write") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="Main"><Sequence memory="true"><Script code="n := 0"/>
<Advance name="left" step="0.25" on_success="n += 1"/></Sequence></BehaviorTree></root>)");
  const std::string run = directory.path("run.jsonl"), file = directory.path("t.test.xml");
  const Outcome ran =
      run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", run});
  INFO(ran.err);
  REQUIRE(ran.code == 0);
  REQUIRE(run_lockstep({"log", "scenario", run, "--save", file, "--name", "once"}).code == 0);
  const std::string text = read_file(file);
  INFO(text);
  CHECK_FALSE(contains(text, "<set"));
  const Outcome again = run_lockstep({"log", "scenario", run, "--save", file, "--name", "once"});
  CHECK(again.code == 2);
  CHECK(contains(again.err, "has a scenario 'once' already"));
}

TEST_CASE("log check says where the leaves of a recording broke their leaf file") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", kTwo), run = directory.path("run.jsonl");
  CHECK(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", run}).code ==
        0);
  const auto check = [&](const std::string& rows) {
    return run_lockstep(
        {"log", "check", run, "--leaves",
         directory.file("t.leaves.xml", "<leaves lockstep=\"1\">" + rows + "</leaves>")});
  };
  const Outcome good = check(R"(<leaf of="Advance" ticks="2..4" result="success"/>)");
  INFO(good.out << good.err);
  CHECK(good.code == 0);
  const Outcome late = check(R"(<leaf path="*/left" ticks="2..3"/>)");
  INFO(late.out << late.err);
  CHECK(late.code == 1);
  CHECK(late.out ==
        "Main/both/left: in tick 3: takes more than 3 ticks, the leaf model allows 2 to 3 (" +
            directory.path("t.leaves.xml") + ":1)\n");
  CHECK(contains(check(R"(<leaf path="*/left" ticks="6"/>)").out,
                 "took 4 ticks, the leaf model allows 6"));
  CHECK(contains(check(R"(<leaf of="Advance" result="failure"/>)").out,
                 "had the result success, which the leaf model does not allow"));
}

TEST_CASE("log check says where a leaf wrote what or when its leaf model does not allow") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="Main"><Sequence memory="true"><Script code="x := 0.0"/>
<Advance name="a" step="0.25" actual="{x}" failure_if="x &gt; 1"/></Sequence></BehaviorTree></root>)");
  const std::string run = directory.path("run.jsonl");
  CHECK(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", run}).code ==
        0);
  const auto check = [&](const std::string& row) {
    return run_lockstep(
        {"log", "check", run, "--leaves",
         directory.file("t.leaves.xml",
                        "<leaves lockstep=\"1\"><leaf of=\"Advance\" " + row + "/></leaves>")});
  };
  const std::string values = R"(out.actual="0.25|0.5|0.75|1" )";
  const Outcome good = check(values);
  INFO(good.out << good.err);
  CHECK(good.code == 0);
  CHECK(check(values + R"(writes="tick")").code == 0);
  const Outcome late = check(values + R"(writes="success")");
  CHECK(late.code == 1);
  CHECK(contains(late.out,
                 "in tick 1: wrote 'x' without a success, the leaf model has writes=\"success\""));
  CHECK(contains(check(values + R"(writes="start")").out,
                 "in tick 1: wrote 'x' after its start, the leaf model has writes=\"start\""));
  CHECK(contains(check(R"(out.actual="0.25|1")").out,
                 "in tick 1: wrote 0.5 to 'x', which the leaf model does not allow"));
}

TEST_CASE("log check blames no leaf for what was written into an entry between ticks") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="T"><Sequence memory="true"><Script code="x := 0.0"/>
<Advance name="a" step="0.1" actual="{x}"/></Sequence></BehaviorTree></root>)");
  const std::string test =
      directory.file("t.test.xml", R"(<scenarios lockstep="1" tree="t.xml"><scenario name="s">
<leaf path="*/a" does="R*5 S[actual=1]"/><set key="x" value="7" tick="3"/><expect result="failure"/>
</scenario></scenarios>)");
  REQUIRE(run_lockstep({"test", test, "--out", directory.path("out")}).code == 1);
  const std::string run = directory.path("out/t.s.jsonl");
  CHECK(contains(read_file(run), R"("entries":[[0,"7"]],"set":[0])"));
  const std::string leaves = directory.file("t.leaves.xml", R"(<leaves lockstep="1">
<leaf path="*/a" out.actual="1" writes="success"/></leaves>)");
  const Outcome it = run_lockstep({"log", "check", run, "--leaves", leaves, "--tree-file", tree});
  INFO(it.out << it.err);
  CHECK(it.code == 0);
}

TEST_CASE("log check sees what a leaf writes when it is halted or held") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="T"><Sequence memory="true"><Script code="x := 0.0"/><Timeout seconds="0.5">
<ParallelAbsolute barriers="0.3"><Advance name="a" step="0.1" actual="{x}"/>
<Advance name="b" step="0.01"/></ParallelAbsolute></Timeout></Sequence></BehaviorTree></root>)");
  const std::string made = directory.path("made.jsonl"), run = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--rate", "10", "--view", "none",
                        "--record", made, "--record-entries", "none"})
              .code == 1);
  const std::string leaves = directory.file("t.leaves.xml", R"(<leaves lockstep="1">
<leaf path="*/a" out.actual="1"/></leaves>)");
  // The same run, with a write of `a` in that tick.
  const auto check = [&](int tick) {
    std::string text = read_file(made);
    const std::string header = R"("nodes":[)";
    text.insert(text.find(header), R"("entries":[{"key":"x","type":"double"}],)");
    const std::size_t line = text.find(fmt::format("{{\"tick\":{},", tick));
    REQUIRE(line != std::string::npos);
    text.insert(text.find("}\n", line), R"(,"entries":[[0,"7"]])");
    return run_lockstep({"log", "check", directory.file("run.jsonl", text), "--leaves", leaves,
                         "--tree-file", tree});
  };
  CHECK(contains(check(1).out, "in tick 1: wrote 7 to 'x'"));
  const Outcome held = check(3);
  INFO(held.out << held.err);
  CHECK(contains(held.out, "in tick 3: wrote 'x' when it was held"));
  CHECK(check(4).code == 0);  // the leaf was not called in it
  CHECK(contains(check(5).out, "in tick 5: wrote 'x' when it was halted"));
}

TEST_CASE("log check knows the tick in which a held leaf was ended and began again") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root BTCPP_format="4"><plugin name="motion"/>
<BehaviorTree ID="T"><RetryUntilSuccessful num_attempts="3">
<ParallelAbsolute barriers="0.5" failure_count="1"><Advance name="a" step="0.5"/>
<Advance name="b" step="0.2"/><Sequence><Sleep msec="300"/><AlwaysFailure/></Sequence>
</ParallelAbsolute></RetryUntilSuccessful></BehaviorTree></root>)");
  const std::string run = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--rate", "10", "--view", "none",
                        "--record", run})
              .code == 1);
  const std::string leaves = directory.file("t.leaves.xml", R"(<leaves lockstep="1">
<leaf path="*/a" held="still"/></leaves>)");
  const Outcome good = run_lockstep({"log", "check", run, "--leaves", leaves});
  INFO(good.out << good.err);
  CHECK(good.code == 0);
  // The hold before the tick of the moments is looked at all the same.
  std::string text = read_file(run);
  const std::string held = R"([2,"running",0.5,0,1])";
  const auto at = text.find("{\"tick\":2");
  REQUIRE(contains(text.substr(0, at), held));
  text.insert(text.find("\"nodes\":[", at) + 9, R"([2,"running",0.7,0,1],)");
  const Outcome moved =
      run_lockstep({"log", "check", directory.file("moved.jsonl", text), "--leaves", leaves});
  INFO(moved.out << moved.err);
  CHECK(contains(moved.out, "in tick 2: moved from 0.5 to 0.7 while it was held"));
}

TEST_CASE("log check knows nothing of ticks that have no line") {
  const TemporaryDirectory directory;
  // What the check says of the run without the ticks from `from` up to `to`.
  const auto check = [&](const std::string& nodes, int from, int to, const std::string& rows) {
    const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="T">)" + nodes + "</BehaviorTree></root>");
    const std::string made = directory.path("made.jsonl");
    REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", made})
                .code == 0);
    std::string text = read_file(made);
    const auto line_of = [&](int tick) { return text.find(fmt::format("{{\"tick\":{},", tick)); };
    const std::string lost = fmt::format(R"("ticks":{},"from":{})", to - from, from);
    text.replace(line_of(from), line_of(to) - line_of(from), "{\"lost\":{" + lost + "}}\n");
    text.insert(text.find("\"overruns\""), fmt::format("\"lost\":{},", to - from));
    return run_lockstep(
        {"log", "check", directory.file("run.jsonl", text), "--leaves",
         directory.file("t.leaves.xml", "<leaves lockstep=\"1\">" + rows + "</leaves>"),
         "--tree-file", tree});
  };
  const Outcome held = check(R"(<ParallelAbsolute barriers="0.2;0.4;0.6;0.8">
<Advance name="a" step="0.2"/><Advance name="b" step="0.1"/></ParallelAbsolute>)",
                             2, 9, R"(<leaf path="*/a" ticks="5"/><leaf path="*/b" ticks="10"/>)");
  INFO(held.out << held.err);
  CHECK(held.code == 0);
  const Outcome again = check(R"(<Repeat times="3"><Advance name="a" step="0.25"/></Repeat>)", 3, 5,
                              R"(<leaf path="*/a" ticks="4"/>)");
  INFO(again.out << again.err);
  CHECK(again.code == 0);
}

TEST_CASE("log check does not take the result of a script for that of its leaf") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="Main"><Sequence memory="true"><Script code="n := 0"/><Retry attempts="3">
<Advance name="a" step="0.5" failure_if="n == 0" on_failure="n := 1"/></Retry></Sequence>
</BehaviorTree></root>)");
  const std::string run = directory.path("run.jsonl");
  CHECK(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", run}).code ==
        0);
  const std::string leaves = directory.file(
      "t.leaves.xml",
      R"(<leaves lockstep="1"><leaf of="Advance" result="success" ticks="2"/></leaves>)");
  const Outcome good = run_lockstep({"log", "check", run, "--leaves", leaves});
  INFO(good.out << good.err);
  CHECK(good.code == 0);
}

TEST_CASE("changes that no scenario notices are named") {
  const TemporaryDirectory directory;
  static_cast<void>(directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="Main"><Sequence memory="true"><Advance name="a" step="0.5"/>
<ParallelAbsolute name="both" barriers="0.5"><Advance name="b" step="0.5"/><Advance name="c" step="0.5"/>
</ParallelAbsolute></Sequence></BehaviorTree></root>)"));
  const std::string head = "<scenarios lockstep=\"1\" tree=\"t.xml\">", tail = "</scenarios>";
  const std::string file = directory.file(
      "t.test.xml", head + R"(<scenario name="x"><leaf path="*" result="success" ticks="3"/>
      <expect result="success"/></scenario>)" +
                        tail);
  const Outcome weak = run_lockstep({"test", file, "--mutate", "--fail-under", "60"});
  INFO(weak.out << weak.err);
  CHECK(weak.code == 1);
  CHECK(contains(weak.out, "no scenario notices: "));
  CHECK(contains(weak.out, "has barriers=\"\" instead of \"0.5\""));
  static_cast<void>(directory.file("t.test.xml", head + R"(
    <scenario name="order"><leaf path="*" result="success" ticks="3"/>
    <expect result="success" ticks="5"/><expect order="a.success; both.success"/></scenario>
    <scenario name="step"><leaf path="b" each="R.6 R.7 R.8 S"/><leaf path="c" each="R.1 R.2 R.4 S"/>
    <expect>never b.progress > 0.65 and c.progress &lt; 0.5</expect>
    <expect>sometimes b.held and c.progress &lt; 0.3</expect></scenario>
    <scenario name="a fails"><leaf path="a" does="F"/><expect result="failure" ticks="1"/></scenario>
    <scenario name="b fails"><leaf path="b" does="F"/><expect result="failure"/></scenario>
    <scenario name="c fails"><leaf path="c" does="F"/><expect result="failure"/></scenario>)" +
                                                     tail));
  const Outcome strong = run_lockstep({"test", file, "--mutate"});
  INFO(strong.out << strong.err);
  CHECK(strong.code == 0);
  CHECK_FALSE(contains(strong.out, "no scenario notices"));
}

TEST_CASE(
    "schema/scenarios.xsd is what the program prints, and describes the scenarios of trees/") {
  const std::string schema = LOCKSTEP_SOURCE_DIR "/schema/scenarios.xsd";
  INFO("schema/scenarios.xsd is stale: lockstep schema --tests > schema/scenarios.xsd");
  CHECK((run_lockstep({"schema", "--tests"}).out == read_file(schema)));
  const auto lint = [&](const std::string& file) {
    const Outcome it =
        run({.arguments = {"--noout", "--schema", schema, file}, .program = "xmllint"});
    INFO(it.err);
    return it.code;
  };
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LOCKSTEP_SOURCE_DIR "/trees")) {
    if (!entry.path().string().ends_with(".test.xml")) continue;
    INFO(entry.path());
    CHECK(lint(entry.path().string()) == 0);
    ++count;
  }
  CHECK(count >= 14);
  const TemporaryDirectory directory;
  for (const std::string wrong : {"<scenaro/>", "<scenario/>", "<leaf path=\"a\" ticks=\"x\"/>",
                                  "<leaf path=\"a\" result=\"no\"/>"}) {
    INFO(wrong);
    CHECK(lint(directory.file("t.test.xml",
                              "<scenarios lockstep=\"1\">" + wrong + "</scenarios>")) != 0);
  }
}

TEST_CASE("docs/testing.md: the first scenario and its failure are as printed there") {
  const std::string page = read_file(LOCKSTEP_SOURCE_DIR "/docs/testing.md");
  const auto block = [&page](const std::string& begin, const std::string& of) {
    const auto from = page.find('\n', page.find(begin, page.find(of))) + 1;
    return page.substr(from, page.find("```", from) - from);
  };
  const TemporaryDirectory directory;
  std::filesystem::create_directories(directory.path("trees"));
  static_cast<void>(directory.file("trees/door_pulling.xml",
                                   read_file(LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml")));
  std::string scenario = block("```xml", "## The first scenario");
  const auto play = [&] {
    static_cast<void>(directory.file("trees/arm_slips.test.xml", scenario));
    const Outcome it = shell("lockstep test trees/arm_slips.test.xml", directory);
    return std::regex_replace(it.out, std::regex(", [0-9.]+ s\n"), ", 0.00 s\n");
  };
  CHECK("$ lockstep test trees/arm_slips.test.xml\n" + play() ==
        block("```\n$ lockstep test", "## The first scenario"));
  scenario.replace(scenario.find("failure"), 7, "success");
  CHECK(play() == block("```", "Now expect `success`"));
}

TEST_CASE("a recording says that a period was one tick, and its readers use it") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="Main">
<RetryUntilSuccessful num_attempts="3"><Action ID="A"/></RetryUntilSuccessful></BehaviorTree></root>)");
  const std::string exact = directory.path("exact.jsonl"), once = directory.path("once.jsonl");
  const auto record = [&](const std::string& run, const char* tick) {
    return run_lockstep({"run", tree, "--mock-leaf", "A=failure", "--clock", "virtual", "--view",
                         "none", "--tick", tick, "--record", run})
        .code;
  };
  REQUIRE(record(exact, "exactly-once") == 1);
  REQUIRE(record(once, "once") == 1);
  CHECK(contains(read_file(exact), R"("tick":"exactly-once")"));
  CHECK_FALSE(contains(read_file(once), "exactly-once"));
  CHECK(contains(run_lockstep({"log", "info", exact}).out, "\n  ticks: exactly-once\n"));
  CHECK(contains(run_lockstep({"log", "diff", once, exact}).out, "exactly-once"));
  const std::string file = directory.path("t.test.xml");
  REQUIRE(run_lockstep({"log", "scenario", exact, "--save", file}).code == 0);
  const std::string text = read_file(file);
  const std::string end = "<expect result=\"failure\"";
  REQUIRE(contains(text, end));
  CHECK(contains(text, " tick=\"exactly-once\""));
  static_cast<void>(directory.file(
      "t.test.xml", std::string(text).insert(text.find(end), "<expect same-as=\"exact.jsonl\"/>")));
  const Outcome played = run_lockstep({"test", file, "--out", directory.path("failed")});
  INFO(read_file(file) << played.out << played.err);
  CHECK(played.code == 0);
}
