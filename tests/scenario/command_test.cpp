// lockstep test from outside: what it finds, prints and writes.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

constexpr auto kTree = R"(<root lockstep="1"><plugin name="motion"/>
<arg name="barriers" default="0.5"/>
<BehaviorTree ID="Main"><ParallelAbsolute name="both" barriers="${barriers}">
<Advance name="left" step="0.1"/><Advance name="right" step="0.1"/>
</ParallelAbsolute></BehaviorTree></root>)";

std::string scenarios(const std::string& text) {
  return "<scenarios lockstep=\"1\" tree=\"t.xml\">\n" + text + "\n</scenarios>\n";
}

// In a folder with t.xml and t.test.xml.
class Folder {
 public:
  explicit Folder(const std::string& text, const std::string& tree = kTree) {
    directory_.file("t.xml", tree);
    file_ = directory_.file("t.test.xml", scenarios(text));
  }
  Outcome test(std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"test", file_, "--out", directory_.path("failed")};
    words.insert(words.end(), more.begin(), more.end());
    return run_lockstep(words);
  }
  std::string path(const std::string& name) const { return directory_.path(name); }
  const TemporaryDirectory& directory() const { return directory_; }
  const std::string& file() const { return file_; }

 private:
  TemporaryDirectory directory_;
  std::string file_;
};

struct Law {
  std::string_view claim, scenario;
  int code;
  std::string_view out;  // is in it
};

// clang-format off
const Law kLaws[] = {
  {"a leaf of which nothing is said succeeds at once",
   R"(<scenario name="a"><expect result="success" ticks="1"/></scenario>)", 0, "1 passed"},
  {"another result", R"(<scenario name="a"><leaf path="left" does="F"/>
   <expect result="success"/></scenario>)", 1, "expected success, came failure"},
  {"another number of ticks", R"(<scenario name="a"><leaf path="*" does="R.5*3 S"/>
   <expect result="success" ticks="2..3"/></scenario>)", 1, "expected 2 to 3 ticks, came 4"},
  {"another time", R"(<scenario name="a" rate="10"><leaf path="*" result="success" seconds="0.4"/>
   <expect time="1..2"/></scenario>)", 1, "expected 1 to 2 s, came 0.5 s"},
  {"the last word stays", R"(<scenario name="a" max-ticks="9"><leaf path="left" does="R.2 R.3"/>
   <expect result="running" ticks="9"/></scenario>)", 0, "1 passed"},
  {"a result after ticks rises evenly", R"(<scenario name="a">
   <leaf of="Advance" result="success" ticks="4"/>
   <expect>never left.progress &gt; 0.76 and left.progress &lt; 0.99</expect>
   <expect result="success" ticks="4"/></scenario>)", 0, "1 passed"},
  {"a property", R"(<scenario name="a"><leaf path="left" does="R.6 R.7 S"/>
   <leaf path="right" does="R.1*3 S"/><expect>never left.held</expect></scenario>)", 1, "'never left.held' is violated in tick 1"},
  {"a property at the end", R"(<scenario name="a"><leaf path="left" does="S"/>
   <leaf path="right" does="R F"/><expect>finally right.success</expect></scenario>)", 1,
   "'finally right.success' is violated at the end, in tick 1"},
  {"an order", R"(<scenario name="a"><leaf path="right" does="R S"/>
   <expect order="left.success; right.success"/></scenario>)", 0, "1 passed"},
  {"another order", R"(<scenario name="a"><leaf path="right" does="R S"/>
   <expect order="right.success; left.success"/></scenario>)", 1,
   "'(left.success) only after (right.success)' is violated in tick 0"},
  {"a measure", R"(<scenario name="a"><leaf path="left" does="R.4 R.4 S"/>
   <leaf path="right" does="R.1 R.3 S"/><expect>spread &lt; 0.31</expect></scenario>)", 0, "1 passed"},
  {"a measure above its limit", R"(<scenario name="a"><leaf path="left" does="R.4 R.4 S"/>
   <leaf path="right" does="R.1 R.3 S"/><expect>spread &lt; 0.2</expect></scenario>)", 1,
   "expected spread < 0.2, came 0.3"},
  {"a measure of one node", R"(<scenario name="a"><leaf path="left" does="R.4 R.4 S"/>
   <leaf path="right" does="R.1 R.3 S"/><expect path="both">spread &lt; 0.2</expect></scenario>)", 1,
   "expected spread < 0.2, came 0.3"},
  {"a measure of a child", R"(<scenario name="a"><leaf path="left" does="R.4 R.4 S"/>
   <leaf path="right" does="R.1 R.3 S"/><expect path="left">held == 0</expect></scenario>)", 0,
   "1 passed"},
  {"a measure of no parallel", R"(<scenario name="a">
   <expect path="left">spread &lt; 0.2</expect></scenario>)", 3, "no parallel or barrier 'left'"},
  {"a property of one node", R"(<scenario name="a">
   <expect path="left">never left.failure</expect></scenario>)", 3,
   "'path' names the node of a measure, not of a property"},
  {"a result comes in the tick at its time, as that of a Wait", R"(<scenario name="a">
   <leaf path="*" result="success" seconds="0.3"/><expect>sometimes left.progress &gt; 0.6</expect>
   <expect result="success" ticks="4"/></scenario>)", 0, "1 passed"},
  {"late ticks are part of that time", R"(<scenario name="a">
   <leaf path="*" result="success" seconds="0.5"/><late tick="1" by="0.35"/>
   <expect ticks="3"/></scenario>)", 0, "1 passed"},
  {"a time in which the leaf is held does not count", R"(<scenario name="a">
   <leaf path="left" result="success" seconds="0.4"/>
   <leaf path="right" does="R.1*4 R.6 S"/><arg name="barriers" value="0.5"/>
   <expect path="left">held == 3</expect><expect result="success" ticks="8"/></scenario>)", 0,
   "1 passed"},
  {"a tick that is withheld, and is not", R"(<scenario name="a"><leaf path="left" does="R.1 ~.2 S"/>
   <expect result="success"/></scenario>)", 1,
   "Main/both/left gets a tick, but its next word is ~0.2: a tick that is withheld"},
  {"ticks that are withheld", R"(<scenario name="a"><arg name="barriers" value="0.5"/>
   <leaf path="left" does="R.6 ~.5 ~.6 S"/><leaf path="right" does="R.1 R.2 R.9 S"/>
   <expect result="success" ticks="4"/></scenario>)", 0, "1 passed"},
  {"a fault put in", R"(<scenario name="a"><leaf path="left" does="R X"/>
   <expect result="fault" node="left" ticks="2"/></scenario>)", 0, "1 passed"},
  {"a fault that nobody expects", R"(<scenario name="a"><leaf path="left" does="X"/>
   <expect>never right.failure</expect></scenario>)", 1, "a leaf failed as a program"},
  {"a run without an end", R"(<scenario name="a"><leaf path="left" does="R"/>
   <expect>never right.failure</expect></scenario>)", 1, "does not end within 10000 ticks"},
  {"an argument", R"(<scenario name="a"><arg name="barriers" value="0.25"/>
   <leaf path="left" does="R.3 R.3 S"/><leaf path="right" does="R.1 R.2 S"/>
   <expect>sometimes left.held</expect></scenario>)", 0, "1 passed"},
  {"the real plugin", R"(<scenario name="a"><leaf of="Advance" from="plugin"/>
   <expect result="success" ticks="10"/></scenario>)", 0, "1 passed"},
  {"rows", R"(<scenario name="a"><row of="left" n="3"/><row of="right" n="5"/>
   <leaf path="${of}" result="failure" ticks="${n}"/><expect result="failure" ticks="1..${n}"/>
   </scenario>)", 0, "a [of=left, n=3]"},
  {"late ticks skip deadlines", R"(<scenario name="a" rate="10"><leaf path="*" does="R*4 S"/>
   <late tick="1" by="0.35"/><expect result="success" ticks="5" time="0.69..0.71"/></scenario>)", 0,
   "1 passed"},
  {"the measured duration has the late ticks too", R"(<scenario name="a" rate="10"><leaf path="*" does="R*4 S"/>
   <late tick="1" by="0.35"/><expect>duration &gt; 0.69</expect><expect>duration &lt; 0.71</expect></scenario>)", 0,
   "1 passed"},
  {"a late tick behind the end", R"(<scenario name="a"><late tick="4" by="0.3"/>
   <expect result="success"/></scenario>)", 1, "tick 4 does not come: the run ends after 1 tick"},
  {"many runs", R"(<scenario name="a" runs="20"><leaf of="Advance" from="plugin"/>
   <expect result="success"/></scenario>)", 0, "20 runs, 200 ticks"},
  {"inputs", R"(<scenario name="a"><expect of="Advance" in.step="0.10"/></scenario>)", 0, "1 passed"},
  {"another input", R"(<scenario name="a"><leaf path="left" does="R S"/>
   <expect path="left" in.step="0.2"/></scenario>)", 1, "expected step 0.2, came 0.1"},
  {"no such input", R"(<scenario name="a"><expect path="left" in.stp="1"/></scenario>)", 3,
   "'Advance' has no input 'stp'"},
  {"no value of the input", R"(<scenario name="a"><expect path="left" in.step="x"/></scenario>)", 3,
   "'x' is not a value of the port 'step'"},
  {"inputs of no leaf", R"(<scenario name="a"><expect path="lift" in.step="1"/></scenario>)", 3,
   "the tree has no leaf 'lift'"},
  {"inputs of a leaf that is the plugin's", R"(<scenario name="a"><leaf path="left" from="plugin"/>
   <expect path="left" in.step="0.1"/></scenario>)", 3, "what 'Main/both/left' gets is not seen"},
  {"an empty argument", R"(<scenario name="a"><arg name="barriers" value=""/>
   <expect result="success"/></scenario>)", 0, "1 passed"},
  {"a measure with a wrong relation", R"(<scenario name="a"><expect>spread = 0.1</expect></scenario>)", 3,
   "expected a limit of the measure 'spread'"},
  {"all behaviors, and what is about one run", R"(<scenario name="a" verify="yes">
   <expect ticks="3"/></scenario>)", 3, "this is about one run, not about all behaviors"},
  {"all behaviors", R"(<scenario name="a" verify="yes"><expect result="success"/></scenario>)", 1,
   "expected success, failure may come"},
};
// clang-format on

}  // namespace

TEST_CASE("what is expected of a scenario") {
  for (const Law& law : kLaws) {
    const Folder folder{std::string(law.scenario)};
    const Outcome it = folder.test();
    INFO(law.claim << '\n' << it.out << it.err);
    CHECK(it.code == law.code);
    CHECK(contains(it.out, std::string(law.out)));
  }
}

TEST_CASE("a value before the first tick declares an entry, as --set does") {
  constexpr auto kEntry = R"(<root lockstep="1"><BehaviorTree ID="T"><Sequence memory="true">
<Wait name="w" seconds="0.2" skip_if="k &gt; 2"/><AlwaysSuccess/></Sequence></BehaviorTree></root>)";
  const auto scenario = [](const std::string& set, int ticks) {
    return R"(<scenario name="a">)" + set + R"(<expect result="success" ticks=")" +
           std::to_string(ticks) + R"("/></scenario>)";
  };
  struct Row {
    const char* set;
    int ticks, code;
  };
  for (const Row& row :
       {Row{R"(<set key="k" value="3"/>)", 1, 0}, Row{R"(<set key="k" value="1" tick="0"/>)", 3, 0},
        Row{R"(<set key="k" value="1" time="0"/>)", 3, 0}, Row{R"(<set key="k" value="x"/>)", 3, 1},
        Row{"", 3, 3}}) {
    const Folder folder(scenario(row.set, row.ticks), kEntry);
    const Outcome it = folder.test();
    INFO(row.set << '\n' << it.out << it.err);
    CHECK(it.code == row.code);
  }
}

TEST_CASE("the leaves of a leaf model know the barriers that <set> gives, as those of --set") {
  const std::string tree = R"(<root lockstep="1"><BehaviorTree ID="T">
<ParallelAbsolute barriers="{bl}"><Action ID="A" name="a"/><Action ID="A" name="b"/>
</ParallelAbsolute></BehaviorTree></root>)";
  const std::string set = R"(<set key="bl" value="0.5"/>)";
  const Folder folder(R"(<scenario name="s" leaves="m.xml" runs="20">)" + set +
                          R"(<expect result="success" ticks="3"/></scenario>)",
                      tree);
  static_cast<void>(folder.directory().file(
      "m.xml",
      R"(<leaves lockstep="1"><leaf path="*" result="success" finish="full" step="1"/></leaves>)"));
  const Outcome played = folder.test();
  CHECK(played.code == 0);
  INFO(played.out << played.err);
  static_cast<void>(folder.directory().file(
      "t.test.xml", scenarios(set + R"(<scenario name="v" leaves="m.xml" verify="yes">
<expect>never a.success and a.progress == 0</expect></scenario>)")));
  CHECK(folder.test().code == 0);
}

TEST_CASE("each verified scenario of a file has its own start values") {
  constexpr auto kEntry =
      R"(<root lockstep="1"><BehaviorTree ID="T"><Check code="goal == 7"/></BehaviorTree></root>)";
  const auto verified = [](const std::string& set, const std::string& results) {
    return "<scenario name=\"" + results + "\" verify=\"yes\">" + set + "<expect result=\"" +
           results + "\"/></scenario>\n";
  };
  const Folder folder(verified(R"(<set key="goal" value="7"/>)", "success") +
                          verified(R"(<set key="goal" value="6" tick="0"/>)", "failure"),
                      kEntry);
  const Outcome it = folder.test();
  INFO(it.out << it.err);
  CHECK(it.code == 0);
  CHECK(contains(it.out, "2 passed"));
  static_cast<void>(folder.directory().file(
      "t.test.xml", scenarios(verified(R"(<set key="goal" value="7" tick="3"/>)", "success"))));
  CHECK(folder.test().code == 3);
}

TEST_CASE("a limit of a measure of nothing is a mistake") {
  const Folder folder(
      R"(<scenario name="s"><expect>spread &lt; -1</expect></scenario>)",
      R"(<root lockstep="1"><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)");
  const Outcome outcome = folder.test();
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.out + outcome.err, "the tree has nothing of which 'spread' is a measure"));
}

TEST_CASE("a value in a later tick declares an entry, which is unset before") {
  constexpr auto kEntry = R"(<root lockstep="1"><BehaviorTree ID="T"><Sequence memory="true">
<Wait seconds="0.2"/><Wait seconds="0.2" skip_if="k &gt; 2"/><Script code="m := k"/></Sequence>
</BehaviorTree></root>)";
  struct Row {
    const char *set, *out;
    int ticks, code;
  };
  for (const Row& row :
       {Row{R"(<set key="k" value="3" tick="1"/>)", "1 passed", 3, 0},
        Row{R"(<set key="k" value="3" time="0.15"/>)", "1 passed", 3, 0},
        Row{R"(<set key="k" value="1" tick="1"/>)", "1 passed", 5, 0},
        Row{R"(<set key="k" value="1" tick="1"/><set key="k" value="3" tick="2"/>)", "1 passed", 3,
            0},
        Row{R"(<set key="k" value="1" tick="0"/><set key="k" value="3" tick="2"/>)", "1 passed", 3,
            0},
        // Too late: the entry is unset where it is read.
        Row{R"(<set key="k" value="3" tick="3"/>)", "without a value", 3, 1},
        Row{R"(<set key="k" value="3" tick="1"/><set key="k" value="x" tick="2"/>)",
            "'x' is not a value of 'k'", 3, 3},
        Row{R"(<set key="j" value="3" tick="1"/>)", "nothing declares the entry 'k'", 3, 3}}) {
    const Folder folder(R"(<scenario name="a">)" + std::string(row.set) +
                            R"(<expect result="success" ticks=")" + std::to_string(row.ticks) +
                            R"("/></scenario>)",
                        kEntry);
    const Outcome it = folder.test();
    INFO(row.set << '\n' << it.out << it.err);
    CHECK(it.code == row.code);
    CHECK(contains(it.out + it.err, row.out));
  }
}

TEST_CASE("log scenario reads a tree of which an entry is declared by a later value only") {
  constexpr auto kEntry = R"(<root lockstep="1"><BehaviorTree ID="T"><Sequence memory="true">
<Wait seconds="0.2"/><Check code="CONDITION"/></Sequence></BehaviorTree></root>)";
  struct Row {
    const char *condition, *value;
  };
  for (const Row& row :
       {Row{"k == 3", "3"}, Row{"k == 3.5", "3.5"}, Row{"k", "true"}, Row{"k == 'a b'", "a b"}}) {
    std::string tree = kEntry;
    tree.replace(tree.find("CONDITION"), 9, row.condition);
    const Folder folder(R"(<scenario name="a"><set key="k" value=")" + std::string(row.value) +
                            R"(" tick="1"/><expect same-as="run.jsonl"/></scenario>)",
                        tree);
    REQUIRE(folder.test({"--update"}).code == 0);
    const Outcome made = run_lockstep({"log", "scenario", folder.path("run.jsonl")});
    INFO(made.out << made.err);
    CHECK(made.code == 0);
    CHECK(
        contains(made.out, R"(<set key="k" value=")" + std::string(row.value) + R"(" tick="1"/>)"));
  }
}

TEST_CASE("start values and arguments are in a recording, so its scenario is the same run") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<arg name="step" default="0.1"/><BehaviorTree ID="T"><Sequence memory="true">
<Script code="n := n + 1"/><Advance name="a" step="${step}" skip_if="n &lt; 6"/></Sequence>
</BehaviorTree></root>)");
  const std::string run = directory.path("run.jsonl"), file = directory.path("t.test.xml");
  for (const char* start : {"n=5", "n=3"}) {
    std::filesystem::remove(file);
    REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--set", start,
                          "--arg", "step=0.5", "--record", run})
                .code == 0);
    const Outcome made = run_lockstep({"log", "scenario", run, "--save", file});
    INFO(made.err);
    REQUIRE(made.code == 0);
    CHECK(contains(read_file(file), R"(<set key="n" value=")" + std::string(start).substr(2)));
    const Outcome played = run_lockstep({"test", file, "--out", directory.path("failed")});
    INFO(read_file(file) << played.out << played.err);
    CHECK(played.code == 0);
  }
}

TEST_CASE(
    "inputs of a leaf that never begins are not as expected, unless all scenarios expect them") {
  constexpr auto kSequence = R"(<root lockstep="1"><plugin name="motion"/><BehaviorTree ID="Main">
<Sequence><Advance name="left" step="0.1"/><Advance name="right" step="0.1"/></Sequence>
</BehaviorTree></root>)";
  const std::string expect = R"(<expect path="right" in.step="0.1"/>)";
  const std::string fails = R"(<leaf path="left" does="F"/><expect result="failure"/>)";
  const Folder own(R"(<scenario name="a">)" + fails + expect + "</scenario>", kSequence);
  const Outcome it = own.test();
  INFO(it.out);
  CHECK(it.code == 1);
  CHECK(contains(it.out, "the leaf never begins"));
  const Folder all(expect + R"(<scenario name="a">)" + fails + "</scenario>", kSequence);
  CHECK(all.test().code == 0);
  // Without the leaf, the scenario still says what it says of the rest.
  const Outcome mutated = all.test({"--mutate"});
  INFO(mutated.out);
  CHECK(contains(mutated.out, "Advance 'right' is left out"));
}

TEST_CASE("a mistake in a scenario is one message") {
  struct Mistake {
    std::string_view scenario, message;
  };
  const Mistake mistakes[] = {
      {R"(<scenario name="a"><expect result="sucess"/></scenario>)", "'result' cannot be 'sucess'"},
      {R"(<scenario name="a"><expect result="success" tolerance="0.1"/></scenario>)",
       "'tolerance' is of an expectation with 'same-as'"},
      {R"(<scenario name="a"></scenario>)", "the scenario expects nothing"},
  };
  for (const Mistake& it : mistakes) {
    const Folder folder{std::string(it.scenario)};
    const Outcome outcome = folder.test();
    INFO(it.scenario << '\n' << outcome.err);
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, std::string(it.message)));
    CHECK_FALSE(contains(outcome.err, "2 errors"));
  }
}

TEST_CASE("a leaf that no plugin has is not one of a plugin") {
  const Folder folder(
      R"(<scenario name="a"><leaf of="Grab" from="plugin"/>
<expect result="success"/></scenario>)",
      R"(<root lockstep="1"><BehaviorTree ID="Main"><Grab/></BehaviorTree></root>)");
  const Outcome it = folder.test();
  INFO(it.out);
  CHECK(it.code == 3);
  CHECK(contains(it.out, "no plugin has 'Grab'"));
  CHECK(contains(it.out,
                 "hint: add the directory that has its plugin to the plugin path: --plugin-path"));
}

TEST_CASE("an error that several scenarios have is reported once") {
  const Folder folder(R"(<scenario name="a"><expect result="success"/></scenario>
<scenario name="b"><expect result="success"/></scenario>)",
                      "<root lockstep=\"1\">");
  const Outcome it = folder.test();
  INFO(it.out);
  CHECK(it.code == 3);
  CHECK(it.out.find("error:") == it.out.rfind("error:"));
  CHECK(contains(it.out, "BAD   b  the same"));
}

TEST_CASE("results do not overwrite what is tested") {
  const Folder folder(
      R"(<scenario name="a"><leaf path="left" from="run.jsonl"/><expect result="success"/></scenario>)");
  const std::string tree = folder.path("t.xml");
  const std::string recording = folder.directory().file("run.jsonl", "");
  for (const std::string option : {"--junit", "--coverage-html", "--lcov"}) {
    for (const std::string& file : {tree, folder.file(), recording}) {
      const Outcome it = folder.test({option, file});
      INFO(option << ' ' << it.err);
      CHECK(it.code == 2);
      CHECK(contains(it.err, "it is the same file as"));
    }
  }
  CHECK(contains(folder.test({"--junit", folder.path("out"), "--lcov", folder.path("./out")}).err,
                 "--junit and --lcov name the same file"));
  const Folder good(R"(<scenario name="a"><expect result="success"/></scenario>)");
  CHECK(good.test({"--junit", "/dev/null", "--lcov", "/dev/null"}).code == 0);
  CHECK(good.test().code == 0);
}

TEST_CASE("where no recording can be written, the failure says so") {
  const Folder folder(R"(<scenario name="a"><expect result="failure"/></scenario>)");
  const std::string file = folder.directory().file("file", "");
  const Outcome it = run_lockstep({"test", folder.file(), "--out", file});
  INFO(it.out);
  CHECK(it.code == 1);
  CHECK(contains(it.out, "there is no recording: "));
}

TEST_CASE("a failure has its place, its tick, its node, a recording and the lines for a shell") {
  const Folder folder(R"(<scenario name="the left one fails">
<leaf path="left" does="R.2 F"/>
<expect result="success"/></scenario>)");
  const Outcome it = folder.test();
  INFO(it.out);
  CHECK(it.code == 1);
  CHECK(contains(it.out, folder.file() + ":4:17: expected success, came failure"));
  CHECK(contains(it.out, "in tick 1: decided by Main/both/left"));
  const std::string recording = folder.path("failed/t.the-left-one-fails.jsonl");
  CHECK(contains(it.out, "lockstep replay " + recording));
  CHECK(contains(it.out, "--filter 'the left one fails'"));
  CHECK(run_lockstep({"log", "info", recording}).code == 0);
  CHECK(contains(it.out, "1 scenario: 0 passed, 1 failed, "));
}

TEST_CASE("scenarios are found in folders, and in tree files") {
  const TemporaryDirectory directory;
  std::filesystem::create_directories(directory.path("deep/er"));
  directory.file("t.xml", kTree);
  directory.file("deep/er/a.test.xml",
                 R"(<scenarios lockstep="1" tree="../../t.xml"><scenario name="deep">
                 <expect result="success"/></scenario></scenarios>)");
  std::string with(kTree);
  with.insert(with.rfind("</root>"),
              R"(<scenario name="inside"><leaf path="left" does="F"/>
              <expect result="failure"/></scenario>)");
  const std::string tree = directory.file("with.xml", with);
  const Outcome it = run_lockstep({"test", directory.path(".")});
  INFO(it.out << it.err);
  CHECK(it.code == 0);
  CHECK(contains(it.out, "ok    deep"));
  CHECK(contains(it.out, "ok    inside"));
  CHECK(contains(it.out, "2 scenarios: 2 passed, "));
  CHECK(run_lockstep({"check", tree}).code == 0);
  const Outcome list = run_lockstep({"test", "--list", directory.path(".")});
  CHECK(lines(list.out).size() == 2);
  CHECK(run_lockstep({"test", "--filter", "deep", directory.path(".")}).code == 0);
  const Outcome none = run_lockstep({"test", "--filter", "depe", directory.path(".")});
  CHECK(none.code == 2);
  CHECK(contains(none.err, "did you mean 'deep'?"));
}

TEST_CASE("what is wrong with scenarios is said at its place") {
  struct Wrong {
    std::string_view text, message;
  };
  // clang-format off
  const Wrong kWrong[] = {
    {R"(<scenario name="a"><leef/><expect result="success"/></scenario>)",
     "2:20: error: unknown element 'leef'"},
    {R"(<scenario name="a"><leaf paht="x" does="S"/><expect result="success"/></scenario>)",
     "unknown attribute 'paht' of 'leaf'"},
    {R"(<scenario name="a"><leaf path="lefd" does="S"/><expect result="success"/></scenario>)",
     "2:32: error: the tree has no leaf 'lefd'"},
    {R"(<scenario name="a"><leaf path="left" does="R Q"/><expect result="success"/></scenario>)",
     "2:46: error: 'Q' is not a word of a leaf"},
    {R"(<scenario name="a"><leaf path="left" does="S[x=1]"/><expect result="success"/></scenario>)",
     "'Advance' has no output 'x'"},
    {R"(<scenario name="a"><expect>never lefd.held</expect></scenario>)", "no node 'lefd'"},
    {R"(<scenario name="a"><expect>spread</expect></scenario>)", "expected a limit of the measure"},
    {R"(<scenario name="a"><expect result="succes"/></scenario>)", "'result' cannot be 'succes'"},
    {R"(<scenario name="a"/>)", "the scenario expects nothing"},
    {R"(<scenario name="a" verify="yes"><leaf path="left" does="S"/></scenario>)",
     "2:33: error: a scenario with verify=\"yes\" is about all behaviors, not about one run"},
    {R"(<scenario name="a" verify="yes"><late tick="1" by="1"/></scenario>)",
     "is about all behaviors, not about one run"},
    {R"(<scenario name="a"><set key="n" value="1"/><expect result="success"/></scenario>)",
     "the tree has no entry 'n'"},
    {R"(<scenario name="a"><expect result="success"/></scenario>
     <scenario name="a"><expect result="success"/></scenario>)", "a scenario 'a' exists already"},
    {R"(<scenario name="a"><expect ticks="${n}"/></scenario>)", "no row of the scenario has 'n'"},
    {R"(<scenario name="a"><arg name="barrier" value="1"/><expect result="success"/></scenario>)",
     "2:31: error: "},
    {R"(<scenario name="a" tree="u.xml"><expect result="success"/></scenario>)", "cannot be read"},
  };
  // clang-format on
  for (const Wrong& wrong : kWrong) {
    const Folder folder{std::string(wrong.text)};
    const Outcome it = folder.test();
    INFO(wrong.text << '\n' << it.out << it.err);
    CHECK(it.code == 3);
    CHECK(contains(it.out + it.err, std::string(wrong.message)));
  }
}

TEST_CASE("a tree for BehaviorTree.CPP has its scenarios beside it") {
  const TemporaryDirectory directory;
  const std::string tree = R"(<root BTCPP_format="4"><BehaviorTree ID="Main"><Sequence>
    <Script code="n := 0"/><A/><B name="b"/></Sequence></BehaviorTree>)";
  directory.file("t.xml", tree + "</root>");
  const std::string file = directory.file("t.test.xml", scenarios(R"(<scenario name="a">
    <leaf of="A" does="R S"/><leaf path="b" does="F"/><expect result="failure" ticks="2"/>
    <expect>finally {n} == 0</expect></scenario>)"));
  const Outcome it = run_lockstep({"test", file});
  INFO(it.out << it.err);
  CHECK(it.code == 0);
  const std::string inside = directory.file("u.xml", tree + "<scenario name=\"a\"/></root>");
  CHECK(contains(run_lockstep({"test", inside}).err, "has no scenarios"));
}

TEST_CASE(
    "in a tree for BehaviorTree.CPP, a value of a scenario has the type that --set gives it") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence>
    <ScriptCondition code="ready"/><Script code="ready = false"/></Sequence></BehaviorTree></root>)");
  CHECK(run_lockstep({"run", tree, "--set", "ready=true", "--clock", "virtual"}).code == 5);
  for (const std::string verify : {"", " verify=\"yes\""}) {
    const std::string file = directory.file(
        "t.test.xml",
        scenarios("<scenario name=\"a\"" + verify + "><set key=\"ready\" value=\"true\"/>" +
                  (verify.empty() ? "<expect result=\"fault\"/>" : "") + "</scenario>"));
    const Outcome it = run_lockstep({"test", file});
    INFO(it.out << it.err);
    CHECK(it.code == (verify.empty() ? 0 : 1));
  }
}

TEST_CASE(
    "a tree that a project file finds is that of scenarios, one that is nowhere is a warning") {
  const TemporaryDirectory directory;
  const std::string root = "<root lockstep=\"1\" main_tree_to_execute=\"M\"><BehaviorTree ID=";
  directory.file("t.xml", root + "\"M\"><SubTree ID=\"Part\"/></BehaviorTree></root>");
  const std::string file = directory.file(
      "t.test.xml", scenarios("<scenario name=\"a\"><expect result=\"failure\"/></scenario>"));
  const Outcome alone = run_lockstep({"test", file, "--out", directory.path("failed")});
  CHECK(alone.code == 1);
  CHECK(contains(alone.err, "warning: unknown tree 'Part'"));
  directory.file("lockstep.project.xml",
                 "<project lockstep=\"1\"><trees folder=\"parts\"/></project>");
  std::filesystem::create_directory(directory.path("parts"));
  directory.file("parts/part.xml",
                 "<root lockstep=\"1\"><BehaviorTree ID=\"Part\"><AlwaysFailure/>"
                 "</BehaviorTree></root>");
  const Outcome found = run_lockstep({"test", file});
  INFO(found.out << found.err);
  CHECK(found.code == 0);
  CHECK(found.err.empty());
}

// As a StatefulActionNode does: a PipelineSequence does not reset it.
TEST_CASE("a played action that has completed keeps its result until its parent resets it") {
  const TemporaryDirectory directory;
  directory.file("t.xml", R"(<root BTCPP_format="4"><plugin name="nav_control"/>
    <BehaviorTree ID="Main"><PipelineSequence><A/><B/></PipelineSequence></BehaviorTree></root>)");
  const std::string file = directory.file("t.test.xml", scenarios(R"(<scenario name="a">
    <leaf of="A" does="S F"/><leaf of="B" does="R R S"/><expect result="success" ticks="3"/>
    </scenario>)"));
  const Outcome it = run_lockstep({"test", file});
  INFO(it.out << it.err);
  CHECK(it.code == 0);
}

TEST_CASE("the substitution rules of BehaviorTree.CPP say what leaves do") {
  const TemporaryDirectory directory;
  directory.file("t.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="Main"><Sequence>
    <A name="first"/><B/><C name="last"/></Sequence></BehaviorTree></root>)");
  directory.file("rules.json", R"({"TestNodeConfigs": {
    "Slow": {"async_delay": 500, "return_status": "SUCCESS"},
    "Bad": {"return_status": "FAILURE", "post_script": "n = 1"}},
    "SubstitutionRules": {"fir*": "Slow", "B": "Slow", "last": "Bad", "nobody": "Bad"}})");
  const std::string file =
      directory.file("t.test.xml", scenarios(R"(<substitutions from="rules.json"/>
    <scenario name="a" rate="10"><expect result="failure" ticks="11"/></scenario>)"));
  const Outcome it = run_lockstep({"test", file});
  INFO(it.out << it.err);
  CHECK(it.code == 0);
  CHECK(contains(it.err, "warning: 'post_script' of 'Bad' is left out"));
}

TEST_CASE("the order of the lines does not depend on the number of threads") {
  std::string text;
  for (int i = 0; i < 50; ++i) {
    text += "<scenario name=\"s" + std::to_string(i) + "\"><leaf path=\"left\" does=\"R*" +
            std::to_string(1 + i % 7) + " S\"/><expect result=\"success\"/></scenario>\n";
  }
  const Folder folder(text);
  const auto result = [&](const std::string& jobs) {
    auto json = nlohmann::json::parse(folder.test({"--json", "-j", jobs}).out);
    json.erase("seconds");
    return json.dump();
  };
  CHECK(result("1") == result("4"));
}

TEST_CASE("a golden recording is written by --update, and compared") {
  const std::string head = R"(<scenario name="a"><leaf path="left" does="R.2 R.)";
  const std::string rest =
      R"( S"/><leaf path="right" does="R S"/><expect same-as="golden/a.jsonl" tolerance="0.05"/></scenario>)";
  const Folder folder(head + "4" + rest);
  CHECK(contains(folder.test().out, "cannot be read"));
  CHECK(contains(folder.test({"--update"}).out, "1 recording written"));
  CHECK(folder.test().code == 0);
  static_cast<void>(folder.directory().file("t.test.xml", scenarios(head + "44" + rest)));
  CHECK(folder.test().code == 0);
  static_cast<void>(folder.directory().file("t.test.xml", scenarios(head + "49" + rest)));
  const Outcome it = folder.test();
  INFO(it.out);
  CHECK(it.code == 1);
  CHECK(contains(it.out, "the run is not that of"));
}

TEST_CASE("a pipe or a device in place of a recording is refused, not waited for") {
  const Folder folder(R"(<scenario name="pipe"><expect same-as="pipe.jsonl"/></scenario>)"
                      R"(<scenario name="device"><expect same-as="/dev/tty"/></scenario>)");
  REQUIRE(mkfifo(folder.path("pipe.jsonl").c_str(), 0600) == 0);
  const Outcome it = folder.test({});
  CHECK(it.code == 1);
  CHECK(contains(it.out, "pipe.jsonl' is not a regular file"));
  CHECK(contains(it.out, "'/dev/tty' is not a regular file"));
}

TEST_CASE("test --update writes over nothing but the recordings of one scenario, in its folder") {
  const auto scenario = [](const std::string& name, const std::string& file) {
    return "<scenario name=\"" + name + "\"><expect same-as=\"" + file + "\"/></scenario>";
  };
  const struct {
    std::string scenarios, why;
  } rows[] = {{scenario("a", "t.xml"), "it is not a recording"},
              {scenario("a", "./t.test.xml"), "it is not a recording"},
              {scenario("a", "notes.txt"), "it is not a recording"},
              {scenario("a", "../other.jsonl"), "it is not below the folder of the scenario file"},
              {scenario("a", "link.jsonl"), "it is a symbolic link"},
              {scenario("a", "pipe.jsonl"), "it is not a recording"},
              {scenario("a", "new/"), "it names a folder"},
              {scenario("a", "gold.jsonl") + scenario("b", "x/../gold.jsonl"),
               "it is the recording of several scenarios"}};
  for (const auto& [text, why] : rows) {
    const Folder folder(text);
    const auto& directory = folder.directory();
    const std::string notes = directory.file("notes.txt", "precious");
    std::filesystem::create_directory(directory.path("x"));
    std::filesystem::create_symlink("../elsewhere.jsonl", directory.path("link.jsonl"));
    REQUIRE(mkfifo(directory.path("pipe.jsonl").c_str(), 0600) == 0);
    const std::string before = read_file(folder.file());
    const Outcome it = folder.test({"--update"});
    INFO(text << '\n' << it.out << it.err);
    CHECK(it.code == (why == std::string("it is a symbolic link") ? 1 : 3));
    CHECK(contains(it.out, why));
    CHECK(read_file(folder.path("t.xml")) == kTree);
    CHECK(read_file(folder.file()) == before);
    CHECK(read_file(notes) == "precious");
    CHECK(!std::filesystem::exists(folder.path("gold.jsonl")));
    CHECK(!std::filesystem::exists(folder.path("../other.jsonl")));
  }
}

TEST_CASE("test --update knows a recording by each of its names") {
  const auto scenario = [](const std::string& name, const std::string& more) {
    return "<scenario name=\"" + name + "\"" + more + "><expect same-as=\"" + name +
           ".jsonl\"/></scenario>";
  };
  const Folder folder(scenario("a", " rate=\"10\"") + scenario("b", " rate=\"20\""));
  REQUIRE(run_lockstep({"run", folder.path("t.xml"), "--clock", "virtual", "--view", "none",
                        "--record", folder.path("a.jsonl")})
              .code < 2);
  std::filesystem::create_hard_link(folder.path("a.jsonl"), folder.path("b.jsonl"));
  const std::string before = read_file(folder.path("a.jsonl"));
  const Outcome it = folder.test({"--update"});
  CHECK(it.code == 3);
  CHECK(contains(it.out, "it is the recording of several scenarios"));
  CHECK(read_file(folder.path("a.jsonl")) == before);
}

TEST_CASE("test --update does not write the recording of a scenario that fails otherwise") {
  const std::string rest = R"(<expect same-as="gold.jsonl"/></scenario>)";
  const Folder folder(R"(<scenario name="a"><expect result="failure"/>)" + rest);
  CHECK(folder.test({"--update"}).code == 1);
  CHECK(!std::filesystem::exists(folder.path("gold.jsonl")));
  // Runs with different seeds are to be the same.
  const Folder good(R"(<scenario name="a" runs="3"><expect result="success"/>)" + rest);
  CHECK(good.test({"--update"}).code == 0);
  CHECK(good.test().code == 0);
}

TEST_CASE("a leaf with seconds has the progress of a Wait in each tick, at any rate") {
  // Its seconds begin at a deadline that is rounded: tick 6 of 30 Hz.
  const std::string tree = R"(<root lockstep="1"><BehaviorTree ID="T"><Sequence memory="true">
    <Wait name="first" seconds="0.15"/>
    <ParallelAbsolute name="p" barriers="0.25;0.5;0.75"><Wait name="slow" seconds="0.5"/>
      <Action ID="Go" name="a"/><Wait name="w" seconds="0.2"/></ParallelAbsolute>
    </Sequence></BehaviorTree></root>)";
  for (const std::string rate : {"30", "60", "7", "100"}) {
    const Folder folder(R"(<leaf path="a" result="success" seconds="0.2"/>
      <scenario name="a" rate=")" +
                            rate + R"("><expect>never a.held and not w.held</expect>
      <expect>never w.held and not a.held</expect><expect same-as="gold.jsonl"/></scenario>)",
                        tree);
    const std::string gold = folder.path("gold.jsonl");
    const std::string file = folder.path("t.xml");
    CHECK(run_lockstep({"run", file, "--rate", rate, "--clock", "virtual", "--view", "none",
                        "--mock-leaf", "Go=success:0.2", "--record", gold})
              .code == 0);
    const Outcome it = folder.test();
    INFO(rate << ": " << it.out << it.err);
    CHECK(it.code == 0);
  }
}

TEST_CASE("a finding without a run does not say that verify shows one") {
  const std::string tree = R"(<root lockstep="1"><BehaviorTree ID="T"><Sequence memory="true">
    <AlwaysFailure/><AlwaysSuccess name="later"/></Sequence></BehaviorTree></root>)";
  const Folder folder(R"(<scenario name="a" verify="yes"><expect result="failure"/></scenario>)",
                      tree);
  const Outcome it = folder.test();
  CHECK(contains(it.out, "finding never-ticked/"));
  CHECK(!contains(it.out, "shows a run to it"));
}

TEST_CASE("a Wait stops at a barrier of a tick, also at a rate whose period is rounded") {
  // One tick is 1/6 of the Wait: 0.2 s at 30 Hz as 0.6 s at 10 Hz.
  const auto waits = [](const std::string& rate, const std::string& first,
                        const std::string& second) {
    const TemporaryDirectory directory;
    const std::string tree =
        directory.file("t.xml",
                       "<root lockstep=\"1\"><BehaviorTree ID=\"T\"><ParallelAbsolute name=\"p\" "
                       "barrier_count=\"6\"><Wait name=\"w\" seconds=\"" +
                           first + "\"/><Wait name=\"b\" seconds=\"" + second +
                           "\"/></ParallelAbsolute></BehaviorTree></root>");
    const Outcome it = run_lockstep(
        {"run", tree, "--rate", rate, "--clock", "virtual", "--view", "none", "--json"});
    INFO(it.out << it.err);
    return parse_json(it.out)["synchronized_nodes"][0]["children"][0]["waits"].get<int>();
  };
  CHECK(waits("30", "0.2", "1") == 6);
  CHECK(waits("10", "0.6", "3") == 6);
}

TEST_CASE("a row with the complete path of a leaf is about that leaf alone") {
  const std::string tree =
      R"(<root lockstep="1" main_tree_to_execute="M"><BehaviorTree ID="M"><Sequence memory="true">
      <Sees name="*" out="{x}"/><Go name="!"/><SubTree ID="N" name="M"/></Sequence></BehaviorTree>
    <BehaviorTree ID="N"><Sequence memory="true"><Go name="!"/></Sequence></BehaviorTree>
    <TreeNodesModel><Action ID="Go"/><Action ID="Sees"><output_port name="out" type="int"/></Action>
    </TreeNodesModel></root>)";
  const Folder folder(R"(<scenario name="a">
      <leaf path="M/Sequence/M/Sequence/!" result="failure" ticks="2"/>
      <leaf path="M/Sequence/!" result="success" ticks="3"/>
      <leaf path="M/Sequence/*" result="success" out.out="7"/>
      <expect result="failure" ticks="4"/></scenario>)",
                      tree);
  const Outcome it = folder.test();
  INFO(it.out << it.err);
  CHECK(it.code == 0);
}

// No model says the type of 'level'. A script gives the entry another number only if it has one.
TEST_CASE("what a leaf without a model writes has the same type from everywhere") {
  const Folder folder(R"(<scenario name="a"><leaf of="Look" result="success" out.level="5"/>
                         <expect result="success"/></scenario>
                         <scenario name="b"><leaf of="Look" does="S[level=far]"/>
                         <expect result="fault"/></scenario>)",
                      R"(<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence>
    <Look level="{n}"/><Script code="n := n + 2"/><ScriptCondition code="n == 7"/>
    </Sequence></BehaviorTree></root>)");
  const Outcome tested = folder.test();
  INFO(tested.out << tested.err);
  CHECK(tested.code == 0);
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"run", folder.path("t.xml"), "--clock", "virtual", "--view", "none"});
    const Outcome it = run_lockstep(more);
    INFO(it.err);
    return it.code;
  };
  const TemporaryDirectory directory;
  CHECK(run({"--mock", "--mock-output", "level=5"}) == 0);
  CHECK(run({"--leaves", directory.file("s.leaves", "M/Sequence/Look = S[level=5]\n")}) == 0);
  const std::string model = directory.file(
      "m.leaves.xml",
      R"(<leaves lockstep="1"><leaf of="Look" result="success" out.level="5"/></leaves>)");
  CHECK(run({"--leaves", model}) == 0);
  CHECK(run_lockstep({"verify", folder.path("t.xml"), "--mock", "--leaves", model}).code == 0);
}

TEST_CASE("a fact in a property of runs is refused with where facts exist") {
  const std::string where =
      "facts exist only in --property and --property-file of `lockstep verify`";
  const Folder folder(R"(<scenario name="a" verify="yes"><expect>never {fact:whole} == true</expect>
                         </scenario>)");
  folder.directory().file("t.test.xml",
                          R"(<scenarios lockstep="1" tree="t.xml" leaves="m.leaves.xml">
    <scenario name="a" verify="yes"><expect>never {fact:whole} == true</expect></scenario></scenarios>)");
  const std::string leaves =
      folder.directory().file("m.leaves.xml", R"(<leaves lockstep="1" rate="10">
    <fact name="whole"/><leaf path="*" result="success"/></leaves>)");
  const Outcome tested = folder.test();
  INFO(tested.out << tested.err);
  CHECK(tested.code == 3);
  CHECK(contains(tested.out, "no entry 'fact:whole'"));
  CHECK(contains(tested.out, where));
  const auto out_of = [&](std::vector<std::string> words, const std::string& property) {
    words.insert(words.end(), {folder.path("t.xml"), "--mock", "--property", property});
    const Outcome it = run_lockstep(words);
    return it.out + it.err;
  };
  CHECK(contains(out_of({"run"}, "never {fact:whole} == true"), where));
  // Of a model that has others, they are named.
  const std::vector<std::string> verify{"verify", "--leaves", leaves};
  CHECK(!contains(out_of(verify, "never {fact:whole} == true"), "no entry"));
  const std::string other = out_of(verify, "never {fact:whola} == true");
  CHECK(contains(other, "did you mean 'fact:whole'?"));
  CHECK(!contains(other, where));
}

TEST_CASE("test --update does not write a recording that differing runs would share") {
  const Folder folder(R"(<scenario name="a" runs="5"><expect same-as="gold.jsonl"/></scenario>)");
  // A leaf that takes as many ticks as the seed chooses.
  folder.directory().file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="M">
    <Action ID="Go" name="g"/></BehaviorTree></root>)");
  folder.directory().file(
      "m.leaves.xml", R"(<leaves lockstep="1" rate="10"><leaf of="Go" ticks="1..9"/></leaves>)");
  folder.directory().file("t.test.xml",
                          R"(<scenarios lockstep="1" tree="t.xml" leaves="m.leaves.xml" rate="10">
    <scenario name="a" runs="5"><expect same-as="gold.jsonl"/></scenario></scenarios>)");
  const auto lines = [&](const Outcome& it) {
    INFO(it.out << it.err);
    CHECK(it.code == 1);
    CHECK(contains(it.out, "run 2, seed 1\n"));
    return it.out;
  };
  const std::string text = lines(folder.test({"--update"}));
  CHECK(contains(text, "the run is not that of run 1: --update does not write '"));
  CHECK(contains(text, "gold.jsonl', which is the recording of several runs"));
  CHECK(!contains(text, "written"));
  CHECK(!std::filesystem::exists(folder.path("gold.jsonl")));
  // Nor over that of one run.
  CHECK(
      run_lockstep({"run", folder.path("t.xml"), "--rate", "10", "--clock", "virtual", "--view",
                    "none", "--mock-leaf", "Go=success:0.4", "--record", folder.path("gold.jsonl")})
          .code == 0);
  const std::string before = read_file(folder.path("gold.jsonl"));
  lines(folder.test({"--update"}));
  CHECK(read_file(folder.path("gold.jsonl")) == before);
}

TEST_CASE("test --update keeps the other names of a recording, and its format") {
  const auto scenarios_with = [](const std::string& file, const std::string& does) {
    return scenarios("<scenario name=\"a\"><leaf path=\"left\" does=\"" + does +
                     "\"/><expect same-as=\"" + file + "\"/></scenario>");
  };
  const Folder folder("");
  const auto update = [&](const std::string& file, const std::string& does) {
    folder.directory().file("t.test.xml", scenarios_with(file, does));
    return folder.test({"--update"});
  };
  for (const std::string file : {"gold.jsonl", "gold.jsonl.zst"}) {
    CHECK(update(file, "R S").code == 0);
    std::filesystem::create_hard_link(folder.path(file), folder.path(file + ".other"));
    const std::string before = read_file(folder.path(file));
    CHECK(before.starts_with(file.ends_with(".zst") ? "\x28\xB5\x2F\xFD" : "{\"lockstep"));
    CHECK(update(file, "R R S").code == 0);
    CHECK(read_file(folder.path(file)) != before);
    CHECK(std::filesystem::equivalent(folder.path(file), folder.path(file + ".other")));
  }
  for (const std::string file : {"gold.mcap", "gold.mcap.zst"}) {
    const Outcome it = update(file, "R S");
    CHECK(it.code == 3);
    CHECK(contains(it.out, "a run is not compared with an MCAP file"));
    CHECK(!std::filesystem::exists(folder.path(file)));
  }
}

TEST_CASE("a recording becomes a scenario that repeats it") {
  const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml";
  const TemporaryDirectory directory;
  const std::string run = directory.path("run.jsonl"), file = directory.path("door.test.xml");
  CHECK(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--arg", "barriers=0.9",
                      "--record", run})
            .code == 1);  // the door jams
  const Outcome saved = run_lockstep({"log", "scenario", run, "--save", file, "--name", "the jam"});
  INFO(saved.err);
  CHECK(saved.code == 0);
  const Outcome it = run_lockstep({"test", file});
  INFO(it.out << it.err);
  CHECK(it.code == 0);
  // Word for word, too.
  const std::string text =
      R"(<scenarios lockstep="1" tree=")" + tree + R"("><scenario name="a" rate="100">
    <arg name="barriers" value="0.9"/><leaf path="*" from="run.jsonl"/>
    <expect same-as="run.jsonl" tolerance="0.000001"/></scenario></scenarios>)";
  const Outcome same = run_lockstep({"test", directory.file("same.test.xml", text)});
  INFO(same.out << same.err);
  CHECK(same.code == 0);
}

TEST_CASE("coverage counts what is possible") {
  const Folder folder(R"(<scenario name="a"><leaf path="*" result="success" ticks="4"/>
    <expect result="success"/></scenario>)");
  const std::string page = folder.path("c.html"), lcov = folder.path("c.info");
  const Outcome some =
      folder.test({"--coverage", "--fail-under", "90", "--coverage-html", page, "--lcov", lcov});
  INFO(some.out << some.err);
  CHECK(some.code == 1);
  CHECK(contains(some.err, "less than 90 %"));
  CHECK(contains(some.out, "of what verify proves possible"));
  CHECK(contains(read_file(page), "<td class=\"a never\">never</td>"));
  CHECK(contains(read_file(lcov), "SF:"));
  const Folder full(R"(<scenario name="a"><leaf path="left" does="R.6 R.6 S"/>
    <leaf path="right" does="R.1 R.2 R.6 S"/><expect result="success"/></scenario>
    <scenario name="b"><leaf path="right" does="R.6 R.6 R.6 S"/><leaf path="left" does="R.1 R.2 R.6 S"/>
    <expect result="success"/></scenario>
    <scenario name="c"><leaf path="left" does="F"/><leaf path="right" does="R"/>
    <expect result="failure"/></scenario>
    <scenario name="d"><leaf path="right" does="F"/><leaf path="left" does="R"/>
    <expect result="failure"/></scenario>)");
  const Outcome all = full.test({"--coverage", "--fail-under", "100"});
  INFO(all.out << all.err);
  CHECK(all.code == 0);
  CHECK(contains(all.out, "100.0 %"));
}

TEST_CASE("a stdout that takes no more is reported once also with coverage") {
  const Folder folder(R"(<scenario name="a"><expect result="success"/></scenario>)");
  const Outcome it = run({.arguments = {"-c", "\"$0\" test \"$1\" --coverage > /dev/full",
                                        LOCKSTEP_BINARY_DIR "/lockstep", folder.file()},
                          .program = "/bin/sh"});
  INFO(it.err);
  CHECK(it.code == 2);
  CHECK(it.err.find("cannot write") == it.err.rfind("cannot write"));
  CHECK(contains(it.err, "cannot write to stdout"));
}

TEST_CASE("what is possible is searched up to 200,000 ticks") {
  const auto coverage = [](const std::string& barriers) {
    const Folder folder(R"(<scenario name="a"><expect result="success"/></scenario>)",
                        R"(<root lockstep="1"><plugin name="motion"/><BehaviorTree ID="T">
      <ParallelAbsolute success_count="2" failure_count="3" barrier_count=")" +
                            barriers + R"(">
        <Advance step="0.1"/><Advance step="0.1"/><Advance step="0.1"/><Advance step="0.1"/>
      </ParallelAbsolute></BehaviorTree></root>)");
    return folder.test({"--coverage"}).out;
  };
  const std::string proved = "of what verify proves possible", all = coverage("8");
  CHECK(contains(coverage("6"), proved));  // in 180,357 ticks; with 8 barriers 493,036
  CHECK(contains(all, "1 passed"));
  CHECK_FALSE(contains(all, proved));
}

TEST_CASE("JUnit's XML is well-formed and counts") {
  const Folder folder(R"(<scenario name="a &lt; &quot;b&quot;"><leaf path="left" does="F"/>
    <expect result="success"/></scenario><scenario name="c"><expect result="success"/></scenario>)");
  const std::string junit = folder.path("junit.xml");
  CHECK(folder.test({"--junit", junit}).code == 1);
  CHECK(run({.arguments = {"--noout", junit}, .program = "xmllint"}).code == 0);
  CHECK(contains(read_file(junit), "tests=\"2\" failures=\"1\" errors=\"0\""));
}

TEST_CASE("the scenarios of trees/ are as expected, and show what is possible") {
  const TemporaryDirectory directory;
  // Of navigate.xml, whose control nodes are of a plugin, nobody knows that one of them never
  // fails.
  // Those of road/ show the mission: on it, each node may be halted by each breakdown.
  const std::string road = LOCKSTEP_SOURCE_DIR "/trees/road/road.test.xml";
  CHECK(run_lockstep({"test", road}).code == 0);
  std::vector<std::string> call{"test",       "--out",        directory.path("failed"),
                                "--coverage", "--fail-under", "99.5"};
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(LOCKSTEP_SOURCE_DIR "/trees")) {
    const std::string file = entry.path().string();
    if (file.ends_with(".test.xml") && file != road) call.push_back(file);
  }
  const Outcome it = run_lockstep(call);
  INFO(it.out << it.err);
  CHECK(it.code == 0);
  CHECK(contains(it.out, " of what verify proves possible\n"));
}

TEST_CASE("a watch plays scenarios again when a file has changed, until a signal") {
  const Folder folder(R"(<scenario name="a"><expect result="success"/></scenario>)");
  Process process({.arguments = {"test", folder.file(), "--watch"}});
  REQUIRE(process.wait_for("1 passed"));
  process.clear_output();
  static_cast<void>(folder.directory().file(
      "t.test.xml", scenarios(R"(<scenario name="other"><expect result="success"/></scenario>)")));
  REQUIRE(process.wait_for("ok    other"));
  REQUIRE(process.wait_for("1 passed"));
  CHECK(process.end_by(SIGINT).code == 130);
}
