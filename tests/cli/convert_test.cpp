// lockstep convert: the same tree in the other language.
#include <algorithm>
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kTheirs = R"(<?xml version="1.0"?>
<!-- the whole -- in two parts -->
<root BTCPP_format="4"main_tree_to_execute="Main tree">
  <plugin name="motion"/>
  <BehaviorTree ID="Main tree">
    <!-- both -->
    <ParallelAbsolute name="a < b"   _uid="3" barriers="0.5;1">
      <Advance step="{=}" />
      <Decorator ID="ForceSuccess"><Advance step='{step}'/></Decorator>
      <SubTree ID="Part" step="0.5"/> text
    </ParallelAbsolute>
  </BehaviorTree>
  <BehaviorTree ID="Part"><Inverter><Inverter><Advance step="{step}"/></Inverter></Inverter>
  </BehaviorTree>
  <TreeNodesModel><Action ID="Advance"><input_port name="step" default="a < b">far</input_port></Action>
  </TreeNodesModel>
</root>
)";

const std::string kOurs = R"(<?xml version="1.0"?>
<!-- the whole - - in two parts -->
<root lockstep="1" main_tree_to_execute="Main tree">
  <plugin name="motion"/>
  <BehaviorTree ID="Main tree">
    <!-- both -->
    <ParallelAbsolute name="a &lt; b" barriers="0.5;1">
      <Advance step="{step}" />
      <ForceSuccess><Advance step='{step}'/></ForceSuccess>
      <SubTree ID="Part" step="0.5"/>
    </ParallelAbsolute>
  </BehaviorTree>
  <BehaviorTree ID="Part"><Inverter><Inverter><Advance step="{step}"/></Inverter></Inverter>
  </BehaviorTree>
  <TreeNodesModel><Action ID="Advance"><input_port name="step" default="a &lt; b">far</input_port></Action>
  </TreeNodesModel>
</root>
)";

std::string ticks(const std::string& tree,
                  const std::vector<std::string>& more = {"--set", "step=0.25"}) {
  std::vector<std::string> words{"run", tree, "--clock", "virtual", "--view", "none", "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = run_lockstep(words);
  INFO(outcome.err);
  REQUIRE(!outcome.out.empty());
  const auto summary = parse_json(outcome.out);
  return summary["result"].get<std::string>() + " " + summary["ticks"].dump();
}

struct Row {
  std::string node;
  std::string message;
};

std::string around(const std::string& root, const std::string& node) {
  return "<root " + root + ">\n<BehaviorTree ID=\"Main\">\n" + node + "\n</BehaviorTree></root>\n";
}

std::string nested(int levels) {
  std::string node = "<AlwaysSuccess/>";
  for (int level = 1; level < levels; ++level) node = "<Inverter>" + node + "</Inverter>";
  return node;
}

}  // namespace

TEST_CASE("convert keeps comments and order, and writes XML") {
  const TemporaryDirectory directory;
  const std::string theirs = directory.file("theirs.xml", kTheirs);
  const Outcome outcome = run_lockstep({"convert", theirs});
  CHECK(outcome.code == 0);
  CHECK(outcome.out == kOurs);
  CHECK(contains(outcome.err, "note: '_uid' is left out"));
  CHECK_FALSE(contains(outcome.err, "TreeNodesModel"));
  CHECK(ticks(directory.file("ours.xml", outcome.out)) == ticks(theirs));
}

TEST_CASE("converted there and back, a tree runs as before") {
  const TemporaryDirectory directory;
  const std::string ours = directory.file("ours.xml", kOurs);
  const Outcome there = run_lockstep({"convert", "--to", "btcpp4", ours});
  CHECK(there.code == 0);
  CHECK(contains(there.err, "warning: BehaviorTree.CPP 4.8.4 and later refuse the ID 'Main tree'"));
  CHECK(contains(there.out, "<root BTCPP_format=\"4\" main"));
  const std::string theirs = directory.file("theirs.xml", there.out);
  CHECK(ticks(theirs) == ticks(ours));
  const Outcome back = run_lockstep({"convert", theirs});
  CHECK(back.code == 0);
  CHECK(ticks(directory.file("back.xml", back.out)) == ticks(ours));
}

TEST_CASE("a script that reads a node by its default name reads the same node after convert") {
  const TemporaryDirectory directory;
  const std::string ours = directory.file("ours.xml", around("lockstep=\"1\"", R"(
<Sequence memory="true" name="top">
<Sequence><AlwaysSuccess/></Sequence>
<Sequence memory="true"><AlwaysSuccess/></Sequence>
<WaitUntil code="status(Sequence#2) == success" timeout="1"/>
<Sequence memory="true"><AlwaysSuccess/></Sequence>
</Sequence>)"));
  const Outcome there = run_lockstep({"convert", "--to", "btcpp4", ours});
  INFO(there.out << there.err);
  CHECK(there.code == 0);
  CHECK(contains(there.out, "<ReactiveSequence name=\"Sequence\">"));
  const auto summary_of = [](const std::string& tree) {
    return run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--json"}).out;
  };
  const auto result_of = [&](const std::string& tree) {
    const auto summary = parse_json(summary_of(tree));
    return summary["result"].get<std::string>() + " " + summary["ticks"].dump();
  };
  CHECK(result_of(directory.file("theirs.xml", there.out)) == result_of(ours));
}

TEST_CASE("convert warns of what BehaviorTree.CPP does not replace") {
  const TemporaryDirectory directory;
  const std::string ours = directory.file(
      "ours.xml",
      "<root lockstep=\"1\">\n<arg name=\"step\" default=\"0.5\"/>\n<BehaviorTree ID=\"Main\">\n"
      "<Sequence>\n<Advance step=\"${step}\"/>\n<Advance step=\"${far}\"/><Advance "
      "step=\"${far}\"/>\n"
      "<Say text=\"$${none}\"/></Sequence>\n</BehaviorTree></root>\n");
  const Outcome there = run_lockstep({"convert", "--to", "btcpp4", ours});
  CHECK(there.code == 0);
  CHECK(contains(there.out, "<arg name=\"step\" default=\"0.5\"/>"));
  CHECK(contains(there.err, "ours.xml:2:1: warning: BehaviorTree.CPP ignores 'arg'"));
  CHECK(contains(there.err, "hint: '${step}' is a text there"));
  CHECK(contains(there.err, "ours.xml:6:16: warning: '${far}' is a text for BehaviorTree.CPP"));
  CHECK_FALSE(contains(there.err, "6:39"));
  CHECK_FALSE(contains(there.err, "none"));
}

TEST_CASE("convert says rounds and counts in the other language's words, and what differs") {
  const TemporaryDirectory directory;
  const std::string their_nodes =
      "<Parallel success_count=\"-1\" failure_count=\"2\">\n"
      "<Repeat num_cycles=\"-1\"><A/></Repeat>\n"
      "<Repeat num_cycles=\"{n}\"><A/></Repeat>\n"
      "<RetryUntilSuccessful num_attempts=\"3\"><A/></RetryUntilSuccessful>\n"
      "<Parallel success_count=\"-2\"><A/><B/></Parallel>\n"
      "<Sleep msec=\"1500\"/>\n"
      "</Parallel>";
  const std::string our_nodes =
      "<Parallel success_count=\"5\" failure_count=\"2\">\n"
      "<Repeat><A/></Repeat>\n"
      "<Repeat times=\"{n}\"><A/></Repeat>\n"
      "<Retry attempts=\"3\"><A/></Retry>\n"
      "<Parallel success_count=\"1\"><A/><B/></Parallel>\n"
      "<Wait seconds=\"1.5\"/>\n"
      "</Parallel>";
  const Outcome here = run_lockstep(
      {"convert", directory.file("theirs.xml", around("BTCPP_format=\"4\"", their_nodes))});
  CHECK(here.code == 0);
  CHECK(here.out == around("lockstep=\"1\"", our_nodes));
  CHECK(contains(here.err, "theirs.xml:4:1: warning: 'Repeat' is not quite the same"));
  CHECK(contains(here.err, "theirs.xml:3:1: warning: 'Parallel' is not quite the same"));
  const Outcome there = run_lockstep({"convert", directory.file("ours.xml", here.out)});
  CHECK(there.code == 0);
  CHECK(contains(there.out, "<Repeat num_cycles=\"-1\"><A/></Repeat>\n"));
  CHECK(contains(there.out, "<RetryUntilSuccessful num_attempts=\"3\">"));
  const Outcome again = run_lockstep({"convert", directory.file("again.xml", there.out)});
  CHECK(again.out == here.out);
}

TEST_CASE("convert says scripts and branches in the other language's words") {
  const TemporaryDirectory directory;
  const std::string their_nodes =
      "<IfThenElse _failureIf=\"n > 3\" _onHalted=\"n := 0\">\n"
      "<ScriptCondition code=\"n == 1\" _post=\"n += 1\"/>\n"
      "<Script code=\"n := 'a &amp;&amp; b'\" _while=\"n &lt; 2\"/>\n"
      "<WhileDoElse _successIf=\"0\"><A _skipIf=\"n\"/><B _onSuccess=\"n := 2\" "
      "_onFailure=\"n := 3\"/></WhileDoElse>\n"
      "</IfThenElse>";
  const std::string our_nodes =
      "<IfThenElse failure_if=\"n > 3\" on_halt=\"n := 0\">\n"
      "<Check code=\"n == 1\" on_end=\"n += 1\"/>\n"
      "<Script code=\"n := 'a &amp;&amp; b'\" while=\"n &lt; 2\"/>\n"
      "<WhileDoElse success_if=\"0\"><A skip_if=\"n\"/><B on_success=\"n := 2\" "
      "on_failure=\"n := 3\"/></WhileDoElse>\n"
      "</IfThenElse>";
  const std::string theirs = around("BTCPP_format=\"4\"", their_nodes);
  const Outcome here = run_lockstep({"convert", directory.file("theirs.xml", theirs)});
  CHECK(here.code == 0);
  CHECK(here.out == around("lockstep=\"1\"", our_nodes));
  const Outcome there = run_lockstep({"convert", directory.file("ours.xml", here.out)});
  CHECK(there.code == 0);
  CHECK(there.out == theirs);
}

TEST_CASE("convert writes the operators and texts of scripts as the other language has them") {
  const TemporaryDirectory directory;
  const std::string our_nodes =
      "<Sequence memory=\"true\"><Script code='k := 0; s := \"or\"'/>\n"
      "<Check code=\"k == 0 and (s == 'or' or k > 5)\"/><AlwaysSuccess skip_if=\"k &lt; 1 "
      "or not_k\" "
      "on_end='s := \"a\"'/></Sequence>";
  const Outcome there =
      run_lockstep({"convert", directory.file("ours.xml", around("lockstep=\"1\"", our_nodes))});
  INFO(there.err);
  CHECK(there.code == 0);
  CHECK(contains(there.out, "code=\"k := 0; s := 'or'\""));
  CHECK(contains(there.out, "code=\"k == 0 &amp;&amp; (s == 'or' || k > 5)\""));
  CHECK(contains(there.out, "_skipIf=\"k &lt; 1 || not_k\" _post=\"s := 'a'\""));
  const Outcome back = run_lockstep({"convert", directory.file("theirs.xml", there.out)});
  CHECK(back.code == 0);
  CHECK(contains(back.out, "code=\"k == 0 &amp;&amp; (s == 'or' || k > 5)\""));
}

TEST_CASE("convert writes no operator by way of an argument of the file") {
  const TemporaryDirectory directory;
  const auto converted = [&](const std::string& value, const std::string& script) {
    const std::string tree = "<root lockstep=\"1\"><arg name=\"x\" default='" + value +
                             "'/>\n<BehaviorTree ID=\"Main\"><Check code='" + script +
                             "'/></BehaviorTree></root>";
    return run_lockstep({"convert", directory.file("tree.xml", tree)});
  };
  const Outcome good = converted("5", "k and ${x} > 3 or k");
  CHECK(good.code == 0);
  CHECK(contains(good.out, "code=\"k &amp;&amp; ${x} > 3 || k\""));
  CHECK(converted("salt and pepper", "k == \"${x}\"").code == 0);
  for (const char* value : {"k and k", "or", "\"a\" == k"}) {
    const Outcome bad = converted(value, "k == ${x}");
    INFO(value << bad.out << bad.err);
    CHECK(bad.code == 3);
    CHECK(contains(bad.err, "tree.xml:2:32: error: a script with this argument cannot"));
  }
  CHECK(contains(converted("5", "k % 2 and k").err, "error: unexpected '%' cannot"));
}

// --- scripts, run in both languages -------------------------------------------------------------

namespace {

std::string escaped(std::string_view text) {
  std::string escaped;
  for (const char it : text) {
    if (it == '&') {
      escaped += "&amp;";
    } else if (it == '<') {
      escaped += "&lt;";
    } else if (it == '"') {
      escaped += "&quot;";
    } else {
      escaped += it;
    }
  }
  return escaped;
}

enum class Where { Condition, Value, Skip, Failure, Success, While, End };
constexpr const char* kHooks[][2] = {{"", ""},
                                     {"", ""},
                                     {"skip_if", "_skipIf"},
                                     {"failure_if", "_failureIf"},
                                     {"success_if", "_successIf"},
                                     {"while", "_while"},
                                     {"on_end", "_post"}};

std::string tree_with(const std::string& script, Where where, bool is_ours) {
  const std::string memory = is_ours ? R"( memory="true")" : "";
  const std::string code = escaped(script), after = R"(<Script code="hit := 1"/>)";
  std::string nodes;
  if (where == Where::Condition) {
    nodes = (is_ours ? "<Check code=\"" : "<ScriptCondition code=\"") + code + "\"/>" + after;
  } else if (where == Where::Value) {
    nodes = "<Script code=\"v := " + code + "\"/>" + after;
  } else {
    const char* const hook = kHooks[static_cast<std::size_t>(where)][is_ours ? 0 : 1];
    nodes = (is_ours ? R"(<Wait seconds="0.3" )" : R"(<Sleep msec="300" )") + std::string(hook) +
            "=\"" + code + "\"/>" + after;
  }
  return around(
      is_ours ? R"(lockstep="1")" : R"(BTCPP_format="4")",
      "<Sequence" + memory +
          R"(><Script code="b := 80; s := 0.5; t := 'docked'; r := true; w := 1; hit := 0; q := ''"/>)" +
          "<ForceSuccess><Sequence" + memory + ">" + nodes +
          "</Sequence></ForceSuccess></Sequence>");
}

struct Played {
  bool is_loaded = false, has_fault = false;
  std::string said = {};  // result, ticks, and when each entry got which value
};

// `true` of BehaviorTree.CPP is the number 1.
Played play(const TemporaryDirectory& directory, const std::string& text) {
  const std::string recording = directory.path("run.jsonl");
  const Outcome run =
      run_lockstep({"run", directory.file("run.xml", text), "--clock", "virtual", "--rate", "10",
                    "--view", "none", "--json", "--record", recording});
  if (run.code == 3) return {};
  const auto summary = parse_json(run.out);
  Played played{.is_loaded = true, .has_fault = summary["result"] == "fault"};
  played.said = summary["result"].dump() + " " + summary["ticks"].dump() + "\n";
  std::vector<std::string> entries =
      lines(run_lockstep({"log", "events", recording, "--event", "entry", "--format", "csv"}).out);
  for (std::string& it : entries) {
    if (it.ends_with(",true")) it.replace(it.size() - 4, 4, "1");
    if (it.ends_with(",false")) it.replace(it.size() - 5, 5, "0");
  }
  std::sort(entries.begin(), entries.end());
  for (const std::string& it : entries) played.said += it + "\n";
  return played;
}

constexpr const char* kScripts[] = {"5",
                                    "0x1F",
                                    "2.5",
                                    "1e3",
                                    "'a text'",
                                    "\"it is\"",
                                    "true",
                                    "false",
                                    "b",
                                    "r",
                                    "1 + 2 * 3",
                                    "7 / 2",
                                    "-1",
                                    "~w",
                                    "'dock' + 'ed' == t",
                                    "'battery: ' .. b",
                                    "'speed: ' .. s",
                                    "0 < s <= 1",
                                    "b > 20 && !(t == 'lost')",
                                    "b < 20 || s == 0",
                                    "b > 50 ? 'go' : 'charge'",
                                    "6 & 3 | 8",
                                    "6 ^ 3",
                                    "0.1 + 0.2 == 0.3",
                                    "'10' < '9'",
                                    "'2.5 m' > 2",
                                    "'16abc' == 16",
                                    "r && 0.5",
                                    "((b + 1) * 2)",
                                    "b - 1 - 1",
                                    "w == 1",
                                    "!r",
                                    "t != 'docked'",
                                    "1 == 1.0",
                                    "r == 'true'",
                                    "0 ? 1 : 2",
                                    "b / 3",
                                    "1 / 0",
                                    "9007199254740991",
                                    "9007199254740993",
                                    "b := 3",
                                    "w += 1",
                                    "s *= 2",
                                    "s -= 0.25; s /= 0.5",
                                    "t += 'x'",
                                    "a := c := 'both'; a .. c",
                                    "b := 79.0",
                                    "b := '75'",
                                    "b := 2.5",
                                    "w := 0.5",
                                    "r := 0",
                                    "r := 5",
                                    "q := 5",
                                    "t := '' .. 5",
                                    "z := 1; z := 2.5",
                                    "z := 'a'; z := 1",
                                    "z := true; z := 7",
                                    "z = 1",
                                    "q := r",
                                    "b == 80 and r",
                                    "b == 80 or r",
                                    "t == \"docked\"",
                                    "t == \"it's\"",
                                    "b > 1 ? (w := 4) : (w := 5)",
                                    "b\n>\n3",
                                    "w=1",
                                    "w = b = 3",
                                    "!(!r)",
                                    "b .. ''",
                                    "true + true",
                                    "'5' == 5",
                                    "'abc' == 0",
                                    "'' == 0",
                                    "z := 5 > 3; z && 1",
                                    "'True' && !'false'"};

}  // namespace

// Entries of lockstep's language have types: there, a script may be an error that it is not in
// the other one. That is reported. Nothing is another value without a word.
TEST_CASE("a converted script has the same ticks and entries, or one language reports an error") {
  const TemporaryDirectory directory;
  int same = 0, refused = 0, number = 0;
  for (const std::string script : kScripts) {
    const Where other = static_cast<Where>(1 + number++ % 6);
    for (const Where where : {Where::Condition, other}) {
      for (const bool is_ours : {true, false}) {
        const std::string text = tree_with(script, where, is_ours);
        const Played here = play(directory, text);
        if (!here.is_loaded) continue;
        const Outcome converted = run_lockstep({"convert", directory.file("tree.xml", text)});
        INFO(text << converted.out << converted.err);
        if (converted.code != 0) {
          CHECK(contains(converted.err, "error"));
          ++refused;
          continue;
        }
        const Played there = play(directory, converted.out);
        const Played& of_ours = is_ours ? here : there;
        if (!of_ours.is_loaded || of_ours.has_fault) continue;
        CHECK(there.said == here.said);
        ++same;
      }
    }
  }
  CHECK(same > 150);
  CHECK(refused > 2);
}

TEST_CASE("convert keeps processing instructions where BehaviorTree.CPP takes them") {
  const TemporaryDirectory directory;
  const std::string ours = directory.file(
      "ours.xml",
      "<?xml version=\"1.0\"?><?style a?><root lockstep=\"1\"><?x y?><BehaviorTree ID=\"Main\">"
      "<AlwaysSuccess/></BehaviorTree></root><?z?>");
  const Outcome there = run_lockstep({"convert", ours});
  CHECK(there.code == 0);
  CHECK(there.out ==
        "<?xml version=\"1.0\"?><?style a?><root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\">"
        "<AlwaysSuccess/></BehaviorTree></root>");
  CHECK(contains(there.err, "note: '<?x y?>' is left out"));
}

TEST_CASE("convert writes only declarations that XML has") {
  const TemporaryDirectory directory;
  const std::string tree =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><AlwaysSuccess/>"
      "</BehaviorTree>";
  const struct {
    std::string before, inside, after;
    bool is_kept;
  } rows[] = {{"<?xml version=\"1.0\"?><?a b?><!DOCTYPE root>", "<?a?>", "<?a?>", true},
              {"\xEF\xBB\xBF<?xml version=\"1.0\"?>", "", "", true},
              {"<!DOCTYPE root [<!ENTITY a \"b\">]>", "", "", false},
              {"<!DOCTYPE root [ ]>", "", "", false},
              {"<!DOCTYPE>", "", "", false},
              {"<!DOCTYPE root><!DOCTYPE root>", "", "", false},
              {"", "<!DOCTYPE root>", "", false},
              {"", "", "<!DOCTYPE root>", false},
              {" <?xml version=\"1.0\"?>", "", "", false},
              {"<?xml version=\"1.0\"?><?xml version=\"1.0\"?>", "", "", false},
              {"<?xml?>", "", "", false},
              {"<?XML a?>", "<? a?>", "<?xml version=\"1.0\"?>", false}};
  for (const auto& [before, inside, after, is_kept] : rows) {
    INFO(before << inside << after);
    const std::string text = before + tree + inside + "</root>" + after;
    const Outcome here = run_lockstep({"convert", directory.file("tree.xml", text)});
    CHECK(here.code == 0);
    CHECK(contains(here.err, "is left out") == !is_kept);
    CHECK(run_lockstep({"check", directory.file("ours.xml", here.out)}).code == 0);
  }
}

TEST_CASE("convert writes 256 levels for BehaviorTree.CPP") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", around("lockstep=\"1\"", nested(256)));
  const Outcome there = run_lockstep({"convert", tree});
  CHECK(there.code == 0);
  const std::string theirs = directory.file("theirs.xml", there.out);
  CHECK(run_lockstep({"check", theirs}).code == 0);
  const std::string deeper =
      directory.file("deeper.xml", around("BTCPP_format=\"4\"", nested(257)));
  CHECK(contains(run_lockstep({"check", deeper}).err, "nested deeper than 256 levels"));
}

TEST_CASE("convert warns of a Sleep that may be held") {
  const TemporaryDirectory directory;
  const auto told = [&](const std::string& node) {
    const std::string tree = around("BTCPP_format=\"4\"", node);
    return run_lockstep({"convert", directory.file("tree.xml", tree)}).err;
  };
  CHECK(told("<Sequence><Sleep msec=\"100\"/></Sequence>").empty());
  CHECK(contains(told("<ParallelRelative delta=\"1\"><Sequence>\n<Sleep msec=\"100\"/></Sequence>"
                      "</ParallelRelative>"),
                 "tree.xml:4:1: warning: 'Sleep' is not quite the same"));
  // By way of SubTrees, too.
  const std::string trees =
      "</BehaviorTree><BehaviorTree ID=\"A\"><SubTree ID=\"B\"/></BehaviorTree>"
      "<BehaviorTree ID=\"B\">\n<Sleep msec=\"1\"/>";
  CHECK(told("<SubTree ID=\"A\"/>" + trees).empty());
  CHECK(contains(told("<ParallelAbsolute><Inverter><SubTree ID=\"A\"/></Inverter>"
                      "</ParallelAbsolute>" +
                      trees),
                 "tree.xml:4:1: warning: 'Sleep' is not quite the same"));
}

TEST_CASE("convert warns of a child that may be skipped, where the languages differ then") {
  const TemporaryDirectory directory;
  const auto told = [&](const std::string& node) {
    const std::string tree = around("BTCPP_format=\"4\"", node)
                                 .insert(23,
                                         "<BehaviorTree ID=\"S\"><ScriptCondition "
                                         "code=\"1\" _skipIf=\"k\"/></BehaviorTree>");
    return run_lockstep({"convert", directory.file("tree.xml", tree)}).err;
  };
  const std::string good = "<ScriptCondition code=\"k\"/>";
  const std::string skipped = "<ScriptCondition code=\"k\" _while=\"k\"/>";
  const std::string decided = "<ScriptCondition code=\"k\" _failureIf=\"k\"/>";
  const std::string rest = "<AlwaysSuccess _skipIf=\"k\"/>";
  const auto branch = [&](const std::string& tag, const std::string& condition) {
    return told("<" + tag + ">" + condition + rest + "</" + tag + ">");
  };
  const std::string is_error = "a condition that is skipped is an error";
  for (const char* tag : {"IfThenElse", "WhileDoElse"}) {
    CHECK(branch(tag, good).empty());
    CHECK(contains(branch(tag, skipped), is_error));
    CHECK(contains(branch(tag, "<Inverter>" + skipped + "</Inverter>"), is_error));
    CHECK(contains(branch(tag, "<SubTree ID=\"S\"/>"), is_error));
    CHECK(contains(branch(tag, "<Sequence>" + skipped + skipped + "</Sequence>"), is_error));
    CHECK(branch(tag, "<Sequence>" + skipped + good + "</Sequence>").empty());
  }
  CHECK(branch("IfThenElse", decided).empty());
  CHECK(contains(branch("WhileDoElse", decided), "runs once in an activation"));
  const auto timed = [&](const std::string& tag, const std::string& child) {
    return told("<" + tag + "=\"10\">" + child + "</" + tag.substr(0, tag.find(' ')) + ">");
  };
  for (const std::string tag : {"Delay delay_msec", "Timeout msec"}) {
    INFO(tag);
    CHECK(timed(tag, good).empty());
    CHECK(contains(timed(tag, skipped), "the time continues after the child was skipped"));
    CHECK(contains(timed(tag, skipped), "warning: "));
    const std::string of_leaf = timed(tag, "<IsOpen/>");
    CHECK(contains(of_leaf, "the time continues after the child was skipped"));
    CHECK(contains(of_leaf, "note: "));
  }
}

TEST_CASE("a Timeout whose child is skipped differs as convert says") {
  const TemporaryDirectory directory;
  const auto ticks_of = [&](const std::string& tree) {
    const Outcome outcome =
        run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--json"});
    return parse_json(outcome.out)["ticks"].get<int>();
  };
  const std::string theirs = directory.file(
      "theirs.xml",
      around("BTCPP_format=\"4\"",
             "<Sequence><Script code=\"n := 0\"/><KeepRunningUntilFailure><Timeout msec=\"50\">"
             "<Sleep msec=\"1000\" _while=\"n += 1; n != 3 &amp;&amp; n != 7\"/></Timeout>"
             "</KeepRunningUntilFailure></Sequence>"));
  const Outcome converted = run_lockstep({"convert", theirs});
  CHECK(contains(converted.err, "warning: 'Timeout' is not quite the same"));
  CHECK(ticks_of(theirs) < ticks_of(directory.file("ours.xml", converted.out)));
}

TEST_CASE("convert tells once that a leaf of a plugin may skip a condition") {
  const TemporaryDirectory directory;
  const auto told = [&](const std::string& condition) {
    const std::string branch = "<IfThenElse>" + condition + "<AlwaysSuccess/></IfThenElse>";
    std::string tree = around("lockstep=\"1\" main_tree_to_execute=\"Main\"",
                              "<Sequence>" + branch + branch + "</Sequence>");
    tree.insert(tree.find("</root>"),
                "<BehaviorTree ID=\"S\"><Inverter><IsOpen/></Inverter></BehaviorTree>");
    return run_lockstep({"convert", directory.file("tree.xml", tree)}).err;
  };
  const std::string is_told = "note: 'IfThenElse' is not quite the same";
  for (const std::string condition :
       {"<IsOpen/>", "<Condition ID=\"IsOpen\"/>", "<Inverter><IsOpen/></Inverter>",
        "<SubTree ID=\"S\"/>", "<Sequence><IsOpen/><IsOpen/></Sequence>"}) {
    const std::string text = told(condition);
    INFO(condition << ": " << text);
    CHECK(contains(text, is_told));
    CHECK(text.find(is_told) == text.rfind(is_told));
    CHECK(contains(text, "returning Skipped"));
  }
  CHECK(told("<Check code=\"k\"/>").empty());
  CHECK(told("<Sequence><IsOpen/><AlwaysSuccess/></Sequence>").empty());
}

TEST_CASE("convert: the time is in proportion to the size of the file") {
  const TemporaryDirectory directory;
  const auto seconds = [&](const std::string& text) {
    const Outcome outcome = run_lockstep({"convert", directory.file("tree.xml", text)});
    CHECK(outcome.code == 0);
    return outcome.cpu_seconds;
  };
  const std::string begin = "<root lockstep=\"1\" main_tree_to_execute=\"M\">\n";
  const auto with_arguments = [&](int count) {
    std::string declared = begin, used;
    for (int i = 0; i < count; ++i) {
      const std::string name = "p" + std::to_string(i);
      declared += "<arg name=\"" + name + "\" default=\"1\"/>\n";
      used += "<AlwaysSuccess name=\"${" + name + "}\"/>\n";
    }
    return declared + "<BehaviorTree ID=\"M\"><Sequence>" + used +
           "</Sequence></BehaviorTree></root>";
  };
  // Each has the next one, which the file has before it, and all of them may be held.
  const auto with_subtrees = [&](int count) {
    std::string text = begin;
    for (int i = count; i-- > 0;) {
      text += "<BehaviorTree ID=\"S" + std::to_string(i) + "\"><IfThenElse><Wait seconds=\"1\"/>";
      text +=
          i + 1 < count ? "<SubTree ID=\"S" + std::to_string(i + 1) + "\"/>" : "<AlwaysSuccess/>";
      text += "</IfThenElse></BehaviorTree>\n";
    }
    return text +
           "<BehaviorTree ID=\"M\"><ParallelAbsolute><SubTree ID=\"S0\"/>"
           "</ParallelAbsolute></BehaviorTree></root>";
  };
  const double few_arguments = seconds(with_arguments(8000));
  const double many_arguments = seconds(with_arguments(32000));
  INFO(few_arguments << " s, " << many_arguments << " s");
  CHECK(many_arguments < 9 * few_arguments);
  const double few_trees = seconds(with_subtrees(8000)), many_trees = seconds(with_subtrees(32000));
  INFO(few_trees << " s, " << many_trees << " s");
  CHECK(many_trees < 9 * few_trees);
  // A condition that has each tree twice, with 60 of them below each other.
  std::string doubled = begin;
  for (int i = 0; i < 60; ++i) {
    const std::string next = "<SubTree ID=\"S" + std::to_string(i + 1) + "\"/>";
    doubled += "<BehaviorTree ID=\"S" + std::to_string(i) + "\"><Sequence>" + next + next +
               "</Sequence></BehaviorTree>\n";
  }
  seconds(doubled +
          "<BehaviorTree ID=\"S60\"><AlwaysSuccess/></BehaviorTree><BehaviorTree ID=\"M\">"
          "<IfThenElse><SubTree ID=\"S0\"/><AlwaysSuccess/></IfThenElse></BehaviorTree>"
          "</root>");
}

TEST_CASE("convert keeps the blackboard of a SubTree of version 3") {
  const TemporaryDirectory directory;
  for (const char* word : {"__autoremap", "__shared_blackboard", "_autoremap"}) {
    const std::string node = std::string("<SubTreePlus ID=\"S\" ") + word + "=\"true\"/>";
    const Outcome here =
        run_lockstep({"convert", directory.file("tree.xml", around("BTCPP_format=\"3\"", node))});
    INFO(word << here.err);
    CHECK(contains(here.out, "<SubTree ID=\"S\" _autoremap=\"true\"/>"));
  }
}

TEST_CASE("convert gives a leaf with the name of a built-in node another name, with a warning") {
  const TemporaryDirectory directory;
  const auto converted = [&](const std::string& format, const std::string& node,
                             const std::string& to) {
    return run_lockstep({"convert", "--to", to, directory.file("tree.xml", around(format, node))});
  };
  const Outcome here = converted(
      "BTCPP_format=\"4\"", "<Wait time=\"3\"></Wait><Action ID=\"Wait\" name=\"w\"/>", "lockstep");
  INFO(here.err);
  CHECK(contains(here.out, "<WaitLeaf time=\"3\"></WaitLeaf><Action ID=\"WaitLeaf\" name=\"w\"/>"));
  CHECK(contains(here.err, "3:1: warning: the leaf 'Wait' is called 'WaitLeaf'"));
  const Outcome model = run_lockstep(
      {"convert", directory.file("model.xml",
                                 "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Wait/>"
                                 "</BehaviorTree><TreeNodesModel><Action ID=\"Wait\"/>"
                                 "</TreeNodesModel></root>")});
  CHECK(contains(model.out, "<Action ID=\"WaitLeaf\"/></TreeNodesModel>"));
  const Outcome there = converted("lockstep=\"1\"", "<Sleep/>", "btcpp4");
  CHECK(contains(there.out, "<SleepLeaf/>"));
}

TEST_CASE("convert writes a BlackboardCheck of version 3 as a WhileDoElse") {
  const TemporaryDirectory directory;
  const auto converted = [&](const std::string& node, const std::string& to) {
    const std::string file = directory.file("tree.xml", around("BTCPP_format=\"3\"", node));
    return run_lockstep({"convert", "--to", to, file});
  };
  const std::string check =
      "<BlackboardCheckInt value_A=\"{n}\" value_B=\"0\" return_on_mismatch=\"SUCCESS\">"
      "<A/></BlackboardCheckInt>";
  const Outcome here = converted(check, "lockstep");
  INFO(here.err);
  CHECK(contains(here.out,
                 "<WhileDoElse><Check code=\"n == 0\"/><A/><AlwaysSuccess/></WhileDoElse>"));
  CHECK(contains(here.err, "3:1: warning: 'BlackboardCheckInt' is not quite the same"));
  const Outcome there = converted(
      "<Decorator ID=\"BlackboardCheckString\" value_A=\"{a}\" value_B=\"on\" "
      "return_on_mismatch=\"FAILURE\"><A/></Decorator>",
      "btcpp4");
  INFO(there.err << there.out);
  CHECK(contains(there.out,
                 "<ScriptCondition code=\"a == 'on'\"/><A/><AlwaysFailure/></WhileDoElse>"));
  CHECK(contains(converted("<BlackboardCheckInt value_A=\"{n}\" value_B=\"0\" "
                           "return_on_mismatch=\"RUNNING\"><A/></BlackboardCheckInt>",
                           "lockstep")
                     .err,
                 "return_on_mismatch=\"RUNNING\" cannot be expressed"));
}

TEST_CASE("convert keeps an entry of a SubTree that is called code") {
  const TemporaryDirectory directory;
  const std::string attributes = "code=\"b and k\"", not_a_script = "code=\"it's @g\"";
  for (const std::string& text : {attributes, not_a_script}) {
    const std::string tree =
        "<root lockstep=\"1\" main_tree_to_execute=\"M\"><BehaviorTree "
        "ID=\"M\"><SubTree ID=\"S\" " +
        text +
        "/></BehaviorTree><BehaviorTree ID=\"S\"><Check code=\"code != ''\"/>"
        "</BehaviorTree></root>";
    const Outcome there = run_lockstep({"convert", directory.file("ours.xml", tree)});
    CHECK(there.code == 0);
    CHECK(contains(there.out, text));
    const Outcome back = run_lockstep({"convert", directory.file("theirs.xml", there.out)});
    CHECK(back.code == 0);
    CHECK(contains(back.out, text));
  }
}

TEST_CASE("convert warns of a fault that the other language may not have") {
  const TemporaryDirectory directory;
  const auto errors = [&](const std::string& value, const std::string& code) {
    const std::string tree =
        "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\"><BehaviorTree ID=\"Main\">"
        "<SubTree ID=\"Lift\" ready=\"" +
        value +
        "\"/></BehaviorTree>"
        "<BehaviorTree ID=\"Lift\"><Script code=\"" +
        code + "\"/></BehaviorTree></root>";
    return run_lockstep({"convert", directory.file("tree.xml", tree)}).err;
  };
  CHECK(contains(errors("true", "ready = false"),
                 "warning: 'ready=true' is not quite the same [not-the-same]"));
  CHECK(contains(errors("true", "ready = false"),
                 "warning: each tick of 'Script' is a fault, whatever the leaves do: its code: "
                 "cannot assign 0 to 'ready', which has the type string [not-the-same]"));
  CHECK(errors("1", "ready = false").empty());
  const Outcome in_result = run_lockstep(
      {"convert", directory.file("tree.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="M">
<Sequence><Script code="c := 1"/><SetBlackboard output_key="c" value="abc"/></Sequence>
</BehaviorTree></root>)")});
  CHECK(contains(in_result.err, "line 2 of the result: each tick of 'Script' is a fault"));
  const Outcome by_model = run_lockstep(
      {"convert", directory.file("tree.xml", R"(<root BTCPP_format="4" main_tree_to_execute="M">
<BehaviorTree ID="M"><SubTree ID="T"/></BehaviorTree><BehaviorTree ID="T">
<Fallback><Condition ID="Ok"/><Script code="c = false"/></Fallback></BehaviorTree><TreeNodesModel>
<SubTree ID="T"><inout_port name="c" default="true"/></SubTree><Condition ID="Ok"/></TreeNodesModel>
</root>)")});
  CHECK(contains(by_model.err, "2:22: warning: 'c=true' is not quite the same"));
}

TEST_CASE("convert warns of an action in the condition of a WhileDoElse") {
  const TemporaryDirectory directory;
  const auto told = [&](const std::string& condition, const std::string& to = "btcpp4") {
    const std::string format = to == "btcpp4" ? "lockstep=\"1\"" : "BTCPP_format=\"4\"";
    const std::string tree =
        around(format, "<WhileDoElse>" + condition + "<Ours seconds=\"9\"/></WhileDoElse>");
    const std::string file = directory.file("tree.xml", tree);
    return contains(run_lockstep({"convert", "--to", to, file}).err,
                    "tree.xml:3:1: warning: 'WhileDoElse' is not quite the same");
  };
  CHECK(told("<Wait seconds=\"1\"/>"));
  CHECK(told("<Inverter><Sequence><Ours/><Wait seconds=\"1\"/></Sequence></Inverter>"));
  CHECK(told("<Action ID=\"Ours\"/>"));
  CHECK(told("<Sleep msec=\"10\"/>", "lockstep"));
  for (const std::string condition :
       {"<Ours/>", "<Condition ID=\"Ours\"/>", "<Check code=\"n == 1\"/>", "<AlwaysSuccess/>"}) {
    CHECK_FALSE(told(condition));
  }
  const std::string modeled =
      "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><WhileDoElse><Ours/><AlwaysSuccess/>"
      "</WhileDoElse></BehaviorTree><TreeNodesModel><Action "
      "ID=\"Ours\"/></TreeNodesModel></root>";
  const std::string file = directory.file("modeled.xml", modeled);
  CHECK(contains(run_lockstep({"convert", "--to", "btcpp4", file}).err, "'WhileDoElse'"));
  // By way of SubTrees, too.
  const std::string trees =
      "</BehaviorTree><BehaviorTree ID=\"Far\"><SubTree ID=\"Near\"/></BehaviorTree>"
      "<BehaviorTree ID=\"Near\"><Wait seconds=\"1\"/></BehaviorTree>"
      "<BehaviorTree ID=\"See\"><AlwaysSuccess/>";
  const auto told_of_tree = [&](const std::string& id) {
    std::string tree =
        around("lockstep=\"1\" main_tree_to_execute=\"Main\"",
               "<WhileDoElse><SubTree ID=\"" + id + "\"/><AlwaysSuccess/></WhileDoElse>" + trees);
    return contains(
        run_lockstep({"convert", "--to", "btcpp4", directory.file("tree.xml", tree)}).err,
        "tree.xml:3:1: warning: 'WhileDoElse' is not quite the same");
  };
  CHECK(told_of_tree("Near"));
  CHECK(told_of_tree("Far"));
  CHECK(told_of_tree("OfAnotherFile"));
  CHECK_FALSE(told_of_tree("See"));
}

TEST_CASE(
    "convert has a note about a leaf in the condition of a WhileDoElse that may be an action") {
  const TemporaryDirectory directory;
  const auto told = [&](const std::string& nodes, const std::string& models = "") {
    std::string tree = around("BTCPP_format=\"4\"", nodes);
    tree.insert(tree.rfind("</root>"), models);
    const Outcome it = run_lockstep({"convert", directory.file("tree.xml", tree)});
    const std::string said = "hint: for BehaviorTree.CPP, it matters whether a leaf that is";
    const auto at = it.err.find(said);
    CHECK(at == it.err.rfind(said));  // once
    return at != std::string::npos;
  };
  const std::string unknown = "<WhileDoElse><See/><Go/></WhileDoElse>";
  CHECK(told(unknown));
  CHECK(told("<Sequence>" + unknown + unknown + "</Sequence>"));
  CHECK(told("<WhileDoElse><Inverter><See/></Inverter><Go/></WhileDoElse>"));
  CHECK_FALSE(told("<WhileDoElse><Condition ID=\"See\"/><Go/></WhileDoElse>"));
  CHECK_FALSE(told("<WhileDoElse><Action ID=\"See\"/><Go/></WhileDoElse>"));  // a warning
  CHECK_FALSE(told("<WhileDoElse><AlwaysSuccess/><Go/></WhileDoElse>"));
  CHECK_FALSE(told("<IfThenElse><See/><Go/></IfThenElse>"));
  for (const std::string kind : {"Condition", "Action"}) {
    const std::string model = "<" + kind + " ID=\"See\"/>";
    CHECK_FALSE(told(unknown, "<TreeNodesModel>" + model + "</TreeNodesModel>"));
  }
}

// The script decides in the first tick: there, AlwaysFailure itself does in the second one.
TEST_CASE("convert says who decides the condition of a WhileDoElse behind its script") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", around("BTCPP_format=\"4\"",
                         "<WhileDoElse><AlwaysFailure _successIf=\"true\"/><Sleep msec=\"300\"/>"
                         "<AlwaysFailure/></WhileDoElse>"));
  const Outcome outcome = run_lockstep({"convert", tree});
  CHECK(contains(outcome.err,
                 "a script that decides the condition runs once in an activation, and "
                 "then the condition itself decides; in lockstep's language"));
  CHECK(ticks(tree, {}) == "failure 2");
  CHECK(ticks(directory.file("ours.xml", outcome.out), {}) == "success 31");
}

TEST_CASE("convert makes a list of the cases of a Switch, and back") {
  const TemporaryDirectory directory;
  const std::string their_nodes =
      "<Control ID=\"Switch2\" variable=\"{mode}\" name=\"m\" case_1=\"dock\" "
      "case_2=\"a;b\"><A/><B/>"
      "<Switch3 variable=\"x\" case_1=\"1\" case_2=\"2\" case_3=\"x\"><A/><A/><A/><A/></Switch3>"
      "</Control>";
  const std::string our_nodes =
      "<Switch name=\"m\" on=\"mode\" cases=\"dock;a\\;b\"><A/><B/>"
      "<Switch on=\"'x'\" cases=\"1;2;x\"><A/><A/><A/><A/></Switch>"
      "</Switch>";
  const Outcome here = run_lockstep(
      {"convert", directory.file("theirs.xml", around("BTCPP_format=\"4\"", their_nodes))});
  CHECK(here.code == 0);
  CHECK(here.out == around("lockstep=\"1\"", our_nodes));
  CHECK(contains(here.err, "theirs.xml:3:1: warning: 'Switch2' is not quite the same"));
  const Outcome there = run_lockstep({"convert", directory.file("ours.xml", here.out)});
  CHECK(there.code == 0);
  CHECK(contains(there.out,
                 "<Switch2 name=\"m\" variable=\"{mode}\" case_1=\"dock\" case_2=\"a;b\">"));
  const Outcome again = run_lockstep({"convert", directory.file("again.xml", there.out)});
  CHECK(again.out == here.out);
}

TEST_CASE("a converted Switch chooses the same child, or convert warns") {
  const TemporaryDirectory directory;
  const auto converted = [&](const std::string& root, const std::string& nodes) {
    return run_lockstep({"convert", directory.file("tree.xml", around(root, nodes))});
  };
  const auto result_of = [&](const std::string& text) {
    return run_lockstep(
               {"run", directory.file("run.xml", text), "--clock", "virtual", "--view", "none"})
        .code;
  };
  const std::string children = "<AlwaysSuccess/><AlwaysFailure/><AlwaysFailure/></Switch";
  const auto ours = [&](const std::string& script, const std::string& cases) {
    return "<Sequence memory=\"true\"><Script code=\"" + script + "\"/><Switch on=\"d\" cases=\"" +
           cases + "\">" + children + "></Sequence>";
  };
  const std::string of_number = "equals that case for BehaviorTree.CPP only";
  const std::string of_flag = "in lockstep's language only";
  const Row numbers[] = {{ours("d := 3 > 2", "true;false"), "case_1=\"1\" case_2=\"0\""},
                         {ours("d := true", "True;0"), "case_1=\"1\" case_2=\"0\""},
                         {ours("d := 1", "true;2"), "case_1=\"1\" case_2=\"2\""},
                         {ours("d := 'true'", "true;false"), "case_1=\"true\" case_2=\"false\""}};
  for (const Row& row : numbers) {
    const Outcome outcome = converted("lockstep=\"1\"", row.node);
    INFO(row.node << outcome.out << outcome.err);
    CHECK(contains(outcome.out, row.message));
    CHECK_FALSE(contains(outcome.err, of_number));
    CHECK_FALSE(contains(outcome.err, of_flag));
    CHECK(result_of(around("lockstep=\"1\"", row.node)) == 0);
    CHECK(result_of(outcome.out) == 0);
  }
  CHECK(contains(converted("lockstep=\"1\"", ours("d := '07'", "7;8")).err, of_number));
  CHECK(contains(converted("lockstep=\"1\"",
                           "<Sequence><Look to=\"{d}\"/><Switch on=\"d\" cases=\"true;false\">" +
                               children + "></Sequence>")
                     .err,
                 "equals the case 'true' " + of_flag));
  const auto theirs = [&](const std::string& script, const std::string& first) {
    return converted("BTCPP_format=\"4\"", "<Sequence><Script code=\"" + script +
                                               "\"/><Switch2 variable=\"{f}\" case_1=\"" + first +
                                               "\" case_2=\"8\">" + children + "2></Sequence>")
        .err;
  };
  CHECK(contains(theirs("f := '07'", "7"), of_number));
  CHECK_FALSE(contains(theirs("f := 7", "7"), of_number));
  CHECK(contains(theirs("f := true", "true"), "equals the case 'true' " + of_flag));
  CHECK_FALSE(contains(theirs("f := 'true'", "true"), of_flag));
}

TEST_CASE("convert tells what check finds wrong in the result only") {
  const TemporaryDirectory directory;
  const auto warnings_of = [&](const std::string& first) {
    const std::string nodes =
        "<Sequence><Script code=\"" + first +
        "\"/><Switch2 variable=\"{x}\" case_1=\"1\" case_2=\"16abc\"><A/><A/><A/></Switch2>"
        "</Sequence>";
    const Outcome outcome = run_lockstep(
        {"convert", directory.file("theirs.xml", around("BTCPP_format=\"4\"", nodes))});
    CHECK(outcome.code == 0);
    return outcome.err;
  };
  CHECK(contains(warnings_of("x := 16"),
                 "theirs.xml: warning: line 3 of the result has an error: the case '16abc' is "
                 "never equal to "));
  CHECK_FALSE(contains(warnings_of("x := 'a'"), "of the result"));
}

TEST_CASE("what lockstep's language cannot say is an error at its place") {
  const TemporaryDirectory directory;
  const Row rows[] = {
      {"<Repeat num_cycles=\"0\"><A/></Repeat>", "3:9: error: num_cycles=\"0\" cannot"},
      {"<RetryUntilSuccessful num_attempts=\"-1\"><A/></RetryUntilSuccessful>",
       "hint: only a positive number can"},
      {"<Parallel success_count=\"-3\"><A/></Parallel>", "error: success_count=\"-3\" cannot"},
      {"<Control ID=\"AsyncSequence\"><A/></Control>", "3:1: error: this 'AsyncSequence' cannot"},
      {"<RunOnce><A/></RunOnce>", "hint: one with then_skip=\"false\" can"},
      {"<Sleep msec=\"{x}\"/>", "3:8: error: msec=\"{x}\" cannot"},
      {"<A skip_if=\"x\"/>", "3:4: error: a port called 'skip_if' cannot"},
      {"<Script code=\"{x}\"/>", "3:9: error: a script in an entry cannot"},
      {"<Precondition if=\"x\"><A/></Precondition>", "3:1: error: this 'Precondition' cannot"},
      {"<Precondition if=\"x\"><A/></Precondition>", "hint: give its child failure_if, success_if"},
      {"<Switch2 variable=\"{x}\" case_1=\"{y}\" case_2=\"2\"><A/><A/><A/></Switch2>",
       "3:25: error: a case that is an entry cannot"},
      {"<Switch2 variable=\"{x}\" case_1=\"1\" case_2=\"1\"><A/><A/><A/></Switch2>",
       "3:36: error: a case that is given twice cannot"},
      {"<Switch2 case_1=\"1\" case_2=\"2\"><A/><A/><A/></Switch2>",
       "3:1: error: a Switch without 'variable' cannot"},
      {"<Switch2 variable=\"{a.b}\" case_1=\"1\" case_2=\"2\"><A/><A/><A/></Switch2>",
       "3:10: error: the key 'a.b' cannot"},
      {"<Switch><A/></Switch>", "3:1: error: a node called 'Switch' cannot"},
      {"<A x=\"{a.b}\"/>", "3:4: error: the key 'a.b' cannot"},
      {"<A name=\"a/b\"/>", "3:4: error: the name 'a/b' cannot"},
      {"<A _skipIf=\"x == and\"/>", "3:18: error: an entry called 'and' cannot"},
      {"<Script code=\"or := 1\"/>", "3:15: error: an entry called 'or' cannot"},
      {"<ScriptCondition code=\"1 &lt; @x\"/>", "3:31: error: the entry '@x' cannot"},
  };
  for (const Row& row : rows) {
    INFO(row.node);
    const std::string tree = directory.file("tree.xml", around("BTCPP_format=\"4\"", row.node));
    const Outcome outcome = run_lockstep({"convert", tree});
    CHECK(outcome.code == 3);
    CHECK(outcome.out.empty());
    INFO(outcome.err);
    CHECK(contains(outcome.err, row.message));
  }
}

// A program registers RED, so no file has its number. In lockstep's language it is an entry.
TEST_CASE("convert refuses the name of a number that a program registers") {
  const TemporaryDirectory directory;
  const auto convert = [&](const std::string& nodes, const std::string& others = "") {
    const std::string tree = directory.file(
        "tree.xml", "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence>\n" + nodes +
                        "\n</Sequence></BehaviorTree>" + others + "</root>\n");
    return run_lockstep({"convert", tree});
  };
  const std::string red = "<ScriptCondition code=\"color == RED\"/>";
  const std::string unused = "<BehaviorTree ID=\"Unused\"><A/></BehaviorTree>";  // no main tree
  const Row refused[] = {
      {red, "2:33: error: the name 'RED' of a number cannot be expressed in lockstep's language"},
      {red,
       "hint: write the number that a program registers for it; no port or script here makes "
       "it an entry, as 'RED := 0' does"},
      {"<A red=\"{Red}\" _skipIf=\"state != STATE_OK\"/>", "2:34: error: the name 'STATE_OK'"},
      {"<Script code=\"x := B2\"/>", "2:20: error: the name 'B2'"},
      {"<A to=\"{n}\"/><Script code=\"n := 1\"/><Switch2 variable=\"{n}\" case_1=\"RED\" "
       "case_2=\"2\"><A/><A/><A/></Switch2>",
       "2:61: error: the name 'RED' of a number cannot"},
  };
  for (const Row& row : refused) {
    for (const std::string& others : {std::string(), unused}) {
      const Outcome outcome = convert(row.node, others);
      INFO(row.node << outcome.err);
      if (!others.empty() && contains(row.node, "Switch2")) continue;  // types are not known
      CHECK(outcome.code == 3);
      CHECK(outcome.out.empty());
      CHECK(contains(outcome.err, row.message));
    }
  }
  const std::string made[] = {
      "<A port=\"{RED}\"/>",
      "<A RED=\"{=}\"/>",
      "<A RED=\"=\"/>",
      "<Script code=\"RED := 1\"/>",
      "<AlwaysSuccess _onSuccess=\"a := RED := 2\"/>",
      "<SetBlackboard output_key=\"RED\" value=\"1\"/>",
      "<SubTree ID=\"Other\" RED=\"1\"/>",
  };
  for (const std::string& it : made) {
    const Outcome outcome = convert(it + red, unused);
    INFO(it << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "color == RED"));
  }
  const std::string models =
      "<TreeNodesModel><SubTree ID=\"Main\"><input_port name=\"RED\"/></SubTree></TreeNodesModel>";
  CHECK(convert(red, unused + models).code == 0);
  directory.file("part.xml",
                 "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Part\"><Script code=\"RED := 1\"/>"
                 "</BehaviorTree></root>");
  CHECK(convert(red, unused + "<include path=\"part.xml\"/>").code == 0);
  // A word of a status is no name. Texts and names that are not in upper case are left alone.
  const Outcome words = convert(
      "<A name=\"arm\"/><WaitUntil code=\"status(arm) == SUCCESS\"/>"
      "<ScriptCondition code=\"color == 'RED' || Red\"/>",
      unused);
  INFO(words.err);
  CHECK(words.code == 0);
  const Outcome open = convert(
      "<A to=\"{n}\"/><Switch2 variable=\"{n}\" case_1=\"RED\" "
      "case_2=\"2\"><A/><A/><A/></Switch2>");
  CHECK(open.code == 0);
  CHECK(
      contains(open.err, "a number to which a program gives the name RED equals that case there"));
}

TEST_CASE("what BehaviorTree.CPP cannot say is an error at its place") {
  const TemporaryDirectory directory;
  const Row rows[] = {
      {"<Parallel memory=\"false\"><A/></Parallel>", "3:1: error: this 'Parallel' cannot"},
      {"<AlwaysRunning/>", "3:1: error: this 'AlwaysRunning' cannot"},
      {"<ReactiveSequence><A/></ReactiveSequence>",
       "3:1: error: a node called 'ReactiveSequence' cannot"},
      {"<Timeout seconds=\"1\"><A/></Timeout>", "hint: one with clock=\"wall\" can"},
      {"<Switch on=\"x + 1\" cases=\"1;2\"><A/><A/><A/></Switch>",
       "3:9: error: a Switch on the script 'x + 1' cannot"},
      {"<Switch on=\"x\" cases=\"1\"><A/><A/></Switch>",
       "3:16: error: a Switch with 1 case cannot"},
      {"<Switch on=\"x\" cases=\"1;2\"><A/><A/></Switch>",
       "hint: add <AlwaysFailure/> as its last child"},
      {"<Wait seconds=\"0.0005\"/>", "3:7: error: seconds=\"0.0005\" cannot"},
      {"<Check code='x == \"it&apos;s\"'/>", "3:19: error: the text \"it's\" cannot"},
      {nested(257), "3:2561: error: a node 257 levels below its tree cannot"},
  };
  for (const Row& row : rows) {
    INFO(row.node);
    const std::string tree = directory.file("tree.xml", around("lockstep=\"1\"", row.node));
    const Outcome outcome = run_lockstep({"convert", tree});
    CHECK(outcome.code == 3);
    INFO(outcome.err);
    CHECK(contains(outcome.err, row.message));
  }
}

TEST_CASE("convert says what is wrong with its file") {
  const TemporaryDirectory directory;
  const std::string ours = directory.file("ours.xml", kOurs);
  const Outcome same = run_lockstep({"convert", "--to", "lockstep", ours});
  CHECK(same.code == 3);
  CHECK(contains(same.err, "is in that language already"));
  CHECK(contains(run_lockstep({"convert", directory.path("none.xml")}).err, "cannot be read"));
  const std::string broken = directory.file("broken.xml", "<root>\n<A");
  CHECK(contains(run_lockstep({"convert", broken}).err, "2:1: error: "));
}

TEST_CASE("convert writes the attributes that it adds behind those of the node") {
  const TemporaryDirectory directory;
  const auto line_of = [&](const std::string& root, const std::string& node) {
    const Outcome outcome =
        run_lockstep({"convert", directory.file("tree.xml", around(root, node))});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    return lines(outcome.out)[2];
  };
  const std::string theirs = "BTCPP_format=\"4\"", ours = "lockstep=\"1\"";
  CHECK(line_of(theirs, "<Sequence name=\"both\"><A/></Sequence>") ==
        "<Sequence name=\"both\" memory=\"true\"><A/></Sequence>");
  CHECK(line_of(theirs, "<Sequence><A/></Sequence>") ==
        "<Sequence memory=\"true\"><A/></Sequence>");
  CHECK(line_of(theirs, "<Timeout  msec=\"100\"  name=\"late\" ><A/></Timeout>") ==
        "<Timeout  seconds=\"0.1\"  name=\"late\" clock=\"wall\" ><A/></Timeout>");
  CHECK(line_of(theirs, "<Control ID=\"Sequence\" name=\"both\" _uid=\"1\"><A/></Control>") ==
        "<Sequence name=\"both\" memory=\"true\"><A/></Sequence>");
  CHECK(line_of(ours, "<Repeat name=\"on\"><A/></Repeat>") ==
        "<Repeat name=\"on\" num_cycles=\"-1\"><A/></Repeat>");
  // A script reads the node by its default name, which is then written, too.
  CHECK(line_of(ours,
                "<Sequence skip_if=\"status(Retry) == running\"><Retry attempts=\"2\"><A/>"
                "</Retry></Sequence>") ==
        "<ReactiveSequence _skipIf=\"status(Retry) == running\" name=\"Sequence\">"
        "<RetryUntilSuccessful num_attempts=\"2\" name=\"Retry\"><A/>"
        "</RetryUntilSuccessful></ReactiveSequence>");
}

TEST_CASE("convert writes a SetBlackboard as a Script") {
  const TemporaryDirectory directory;
  const auto converted = [&](const std::string& node) {
    const std::string tree = directory.file("set.xml", around("BTCPP_format=\"4\"", node));
    return run_lockstep({"convert", tree});
  };
  const auto line_of = [&](const std::string& attributes) {
    const Outcome outcome = converted("<SetBlackboard " + attributes + "/>");
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    const auto begin = outcome.out.find("<Script");
    REQUIRE(begin != std::string::npos);
    return outcome.out.substr(begin, outcome.out.find('\n', begin) - begin);
  };
  CHECK(line_of(R"(output_key="stage" value="1")") == R"(<Script code="stage := 1"/>)");
  CHECK(line_of(R"(value="-0.5" output_key="far" name="n")") ==
        R"(<Script name="n" code="far := -0.5"/>)");
  CHECK(line_of(R"(output_key="on" value="true")") == R"(<Script code="on := true"/>)");
  CHECK(line_of(R"(output_key="who" value="arm 1")") == R"(<Script code="who := 'arm 1'"/>)");
  CHECK(line_of(R"(output_key="who" value="")") == R"(<Script code="who := ''"/>)");
  CHECK(line_of(R"(output_key="who" value="it's")") ==
        R"(<Script code="who := &quot;it's&quot;"/>)");
  CHECK(line_of(R"(output_key="to" value="{from}" _skipIf="far")") ==
        R"(<Script skip_if="far" code="to := from"/>)");
  const Outcome explicit_form =
      converted(R"(<Action ID="SetBlackboard" output_key="a" value="007"/>)");
  CHECK(contains(explicit_form.out, R"(<Script code="a := '007'"/>)"));
  // A text that a number would change is a text.
  for (const std::string text : {"007", "1.0", "1e3", "-0", " 5 ", "+5", "True"}) {
    CHECK(line_of("output_key=\"k\" value=\"" + text + "\"") ==
          "<Script code=\"k := '" + text + "'\"/>");
  }
  CHECK(converted(R"(<SetBlackboard output_key="a b" value="1"/>)").code == 3);
  CHECK(converted(R"(<SetBlackboard output_key="a"/>)").code == 3);
  const Outcome by_name = converted(R"(<SetBlackboard output_key="{k}" value="1"/>)");
  CHECK(by_name.code == 3);
  CHECK(contains(by_name.err, "if 'k' itself is meant, write output_key=\"k\""));
}

TEST_CASE("convert writes a SetBlackboard with the type of its entry") {
  const TemporaryDirectory directory;
  const auto converted = [&](const std::string& value, const std::string& use,
                             const std::string& models = {}) {
    std::string tree =
        around("BTCPP_format=\"4\"", "<Sequence><SetBlackboard value=\"" + value +
                                         "\" output_key=\"x\"/>" + use + "</Sequence>");
    tree.insert(tree.find("</root>"), "<TreeNodesModel>" + models + "</TreeNodesModel>");
    return run_lockstep({"convert", directory.file("set.xml", tree)});
  };
  const auto model = [](const std::string& type) {
    return "<Action ID=\"Say\"><input_port name=\"text\" type=\"" + type + "\"/></Action>";
  };
  const std::string say = "<Say text=\"{x}\"/>";
  CHECK(contains(converted("1", say, model("std::string")).out, "code=\"x := '1'\""));
  CHECK(contains(converted("true", say, model("std::string")).out, "code=\"x := 'true'\""));
  CHECK(contains(converted("007", say, model("int")).out, "code=\"x := 7\""));
  CHECK(contains(converted("1.0", say, model("double")).out, "code=\"x := 1\""));
  CHECK(contains(converted("1", say, model("bool")).out, "code=\"x := true\""));
  CHECK(contains(converted("5", "<Script code=\"x := 'a'\"/>").out, "code=\"x := '5'\""));
  CHECK(contains(converted("05", "<Script code=\"x := 3\"/>").out, "code=\"x := 5\""));
  const std::string is_text_there = "warning: 'x := 5' is not quite the same";
  CHECK(contains(converted("5", "<Script code=\"x := 3\"/>").err, is_text_there));
  CHECK_FALSE(contains(converted("5", "<ScriptCondition code=\"x == 3\"/>").err, is_text_there));
  CHECK_FALSE(contains(converted("5", say, model("int")).err, is_text_there));
  const Outcome two_types = converted("5", "<Script code=\"x := 3\"/><Script code=\"x = true\"/>");
  CHECK(contains(two_types.err, "x := 5' is not quite the same"));
  const Outcome text = converted("true", "<Script code=\"x := 3\"/>");
  CHECK(contains(text.err, "x := 'true'' is not quite the same"));
  const std::string is_told = "note: the type of the entry in 'x := 1' is not known";
  CHECK(contains(converted("1", say).err, is_told));
  CHECK_FALSE(contains(converted("1", say, model("int")).err, is_told));
  CHECK_FALSE(contains(converted("one", say).err, "is not known"));
}

TEST_CASE("convert writes a start value of a SubTree with the type of its entry") {
  const TemporaryDirectory directory;
  const auto tree = [](const std::string& attribute, const std::string& inside) {
    return "<root lockstep=\"1\" main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><SubTree "
           "ID=\"S\" " +
           attribute + "/></BehaviorTree><BehaviorTree ID=\"S\"><Sequence memory=\"true\">" +
           inside + "</Sequence></BehaviorTree></root>";
  };
  const auto converted = [&](const std::string& text) {
    return run_lockstep({"convert", directory.file("tree.xml", text)});
  };
  const auto result_of = [&](const std::string& text) {
    return run_lockstep({"run", directory.file("run.xml", text), "--clock", "virtual", "--view",
                         "none", "--mock"})
        .code;
  };
  const Row rows[] = {
      {tree("k=\"true\"", "<Script code=\"k := !k\"/><Check code=\"!k\"/>"), "k=\"1\""},
      {tree("k=\"false\"", "<Check code=\"!k\"/><Script code=\"k := true\"/>"), "k=\"0\""},
      {tree("k=\"1\"", "<Script code=\"k := 0.5\"/><Check code=\"k == 0.5\"/>"), "k=\"1.0\""},
      {tree("k=\"5\"", "<Script code=\"k += 1\"/><Check code=\"k == 6\"/>"), "k=\"5\""},
      {tree("k=\"true\"", "<Say text=\"{k}\"/>"), "k=\"true\""},
      {tree("k=\"true\"", "<Script code=\"k := 'a'\"/><Check code=\"k == 'a'\"/>"), "k=\"true\""},
  };
  for (const Row& row : rows) {
    const Outcome outcome = converted(row.node);
    INFO(row.node << outcome.out << outcome.err);
    CHECK(contains(outcome.out, row.message));
    CHECK(outcome.err.empty());
    CHECK(result_of(row.node) == 0);
    CHECK(result_of(outcome.out) == 0);
  }
  const std::string is_told = "may be another value for BehaviorTree.CPP";
  CHECK(contains(converted(tree("k=\"true\"", "<Say text=\"{k}\"/><Check code=\"k\"/>")).err,
                 "warning: 'true' " + is_told));
  CHECK(contains(converted(tree("k=\"5\"", "<Script code=\"k := 'a'\"/>")).err,
                 "warning: '5' " + is_told));
  const std::string with_switch =
      "<Switch on=\"k\" cases=\"true;false\"><AlwaysSuccess/><AlwaysSuccess/><AlwaysFailure/>"
      "</Switch>";
  CHECK_FALSE(contains(converted(tree("k=\"true\"", with_switch)).err, is_told));
  CHECK(contains(converted(tree("k=\"true\"", "<Script code=\"k := !k\"/>" + with_switch)).err,
                 is_told));
}

TEST_CASE("convert writes a SequenceWithMemory as a Sequence, and says what differs") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "memory.xml",
      around("BTCPP_format=\"4\"", "<SequenceWithMemory><Clean/></SequenceWithMemory>"));
  const Outcome outcome = run_lockstep({"convert", tree});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "<Sequence memory=\"true\"><Clean/></Sequence>"));
  CHECK(contains(outcome.err, "warning: 'SequenceWithMemory' is not quite the same"));
  CHECK(contains(outcome.err, "it begins with the first child"));
}

TEST_CASE("convert keeps barriers and pools, in both directions") {
  const TemporaryDirectory directory;
  const auto text = [&](const std::string& root, const std::string& leaf) {
    return "<root " + root + ">\n  <barrier name=\"meet\" barriers=\"0.5\"/>\n" +
           "  <resources name=\"yard\" resources=\"dock\" increment=\"2\"/>\n"
           "  <BehaviorTree ID=\"Main\"><Parallel>\n"
           "    <SyncProgress barrier=\"meet\"><UseResources pool=\"yard\" resources=\"dock\" "
           "keep=\"true\">" +
           leaf + "</UseResources></SyncProgress>\n    <SyncProgress barrier=\"meet\">" + leaf +
           "</SyncProgress>\n    <WaitUntil code=\"progress(meet) >= 0\"/></Parallel>"
           "</BehaviorTree>\n</root>\n";
  };
  const std::string ours = text("lockstep=\"1\"", "<Go/>");
  const std::string theirs = text("BTCPP_format=\"4\"", "<Go/>");
  CHECK(run_lockstep({"convert", directory.file("ours.xml", ours)}).out == theirs);
  CHECK(run_lockstep({"convert", directory.file("theirs.xml", theirs)}).out == ours);
}

TEST_CASE("convert --to btcpp4 takes a file for version 3") {
  const TemporaryDirectory directory;
  const std::string before = R"(<?xml version="1.0"?>
<root main_tree_to_execute="Main">
  <!-- all -->
  <BehaviorTree ID="Main">
    <SequenceStar name="s">
      <SubTreePlus ID="Go" x="8" y="{y}" __autoremap="1"/>
      <SubTree ID="Go" x="place" __shared_blackboard="true"/>
      <Control ID="FallbackStar"><Decorator ID="RetryUntilSuccesful" num_attempts="2"><Drive to="${goal}"/></Decorator></Control>
      <Parallel threshold="1"><Drive threshold="1"/></Parallel>
    </SequenceStar>
  </BehaviorTree>
  <BehaviorTree ID="Go"><Drive to="{x}"/></BehaviorTree>
  <TreeNodesModel><SubTreePlus ID="Go"/></TreeNodesModel>
</root>
)";
  const std::string since = R"(<?xml version="1.0"?>
<root BTCPP_format="4" main_tree_to_execute="Main">
  <!-- all -->
  <BehaviorTree ID="Main">
    <SequenceWithMemory name="s">
      <SubTree ID="Go" x="8" y="{y}" _autoremap="1"/>
      <SubTree ID="Go" x="{place}" _autoremap="true"/>
      <Control ID="Fallback"><Decorator ID="RetryUntilSuccessful" num_attempts="2"><Drive to="{goal}"/></Decorator></Control>
      <Parallel success_count="1"><Drive threshold="1"/></Parallel>
    </SequenceWithMemory>
  </BehaviorTree>
  <BehaviorTree ID="Go"><Drive to="{x}"/></BehaviorTree>
  <TreeNodesModel><SubTree ID="Go"/></TreeNodesModel>
</root>
)";
  const Outcome outcome =
      run_lockstep({"convert", "--to", "btcpp4", directory.file("3.xml", before)});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out == since);
  CHECK(contains(outcome.err, "'place' is taken for an entry"));
  const Outcome again = run_lockstep({"convert", "--to", "btcpp4", directory.file("4.xml", since)});
  CHECK(again.code == 3);
  CHECK(contains(again.err, "is in that language already"));
  const std::string gone = directory.file(
      "gone.xml",
      "<root BTCPP_format=\"3\"><BehaviorTree ID=\"A\"><BlackboardCheckInt "
      "value_A=\"{a}\" value_B=\"1\"><Go/></BlackboardCheckInt></BehaviorTree></root>");
  const Outcome not_there = run_lockstep({"convert", "--to", "btcpp4", gone});
  CHECK(not_there.code == 3);
  CHECK(contains(not_there.err, "version 4 has no 'BlackboardCheckInt'"));
}

TEST_CASE("convert reads the entries of a file for version 3 in both directions") {
  const TemporaryDirectory directory;
  const std::string file = directory.file(
      "3.xml",
      "<root main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><Sequence>\n<SubTree ID=\"Go\" "
      "to=\"place\"/><SubTreePlus ID=\"Go\" to=\"text\"/><Drive to=\"${goal}\"/></Sequence>"
      "</BehaviorTree><BehaviorTree ID=\"Go\"><Drive to=\"{to}\"/></BehaviorTree></root>");
  for (const std::string to : {"lockstep", "btcpp4"}) {
    const Outcome outcome = run_lockstep({"convert", "--to", to, file});
    INFO(to << outcome.err << outcome.out);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out,
                   "<SubTree ID=\"Go\" to=\"{place}\"/><SubTree ID=\"Go\" to=\"text\"/>"
                   "<Drive to=\"{goal}\"/>"));
    CHECK(contains(outcome.err, "3.xml:2:22: warning: 'place' is taken for an entry"));
    CHECK(contains(outcome.err, "remove the braces that the result has around it: to=\"place\""));
    CHECK_FALSE(contains(outcome.err, "'text' is taken"));
  }
}

TEST_CASE("convert writes the defaults that the model of a SubTree gives its ports") {
  const TemporaryDirectory directory;
  const auto tree = [](const std::string& root, const std::string& check,
                       const std::string& subtrees) {
    return "<root " + root +
           " main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><Inverter><Inverter>" + subtrees +
           "</Inverter></Inverter></BehaviorTree><BehaviorTree ID=\"S\"><" + check +
           " code=\"go == 'yes' &amp;&amp; n == 3\"/></BehaviorTree><TreeNodesModel>"
           "<SubTree ID=\"S\"><input_port name=\"go\" default=\"yes\"/><inout_port name=\"n\" "
           "default=\"{w}\"/><output_port name=\"way\" default=\"{=}\"/></SubTree>"
           "</TreeNodesModel></root>";
  };
  const auto run = [&](const std::string& text) {
    return run_lockstep({"run", directory.file("run.xml", text), "--clock", "virtual", "--view",
                         "none", "--set", "w=3"})
        .code;
  };
  const auto converted = [&](const std::string& text) {
    return run_lockstep({"convert", directory.file("tree.xml", text)});
  };
  const std::string theirs = "BTCPP_format=\"4\"", ours = "lockstep=\"1\"";
  const std::string text = tree(theirs, "ScriptCondition", "<SubTree ID=\"S\"/>");
  CHECK(run(text) == 0);
  const Outcome here = converted(text);
  INFO(here.err << here.out);
  CHECK(contains(here.out, "go=\"yes\""));
  CHECK(contains(here.out, "n=\"{w}\""));
  CHECK(contains(here.out, "way=\"{way}\""));
  CHECK(run(here.out) == 0);
  // Those that are given, or passed on, have no default.
  CHECK(contains(
      converted(tree(theirs, "ScriptCondition", "<SubTree ID=\"S\" go=\"no\" n=\"1\" way=\"2\"/>"))
          .out,
      "<SubTree ID=\"S\" go=\"no\" n=\"1\" way=\"2\"/>"));
  CHECK(contains(
      converted(tree(theirs, "ScriptCondition", "<SubTree ID=\"S\" _autoremap=\"true\"/>")).out,
      "<SubTree ID=\"S\" _autoremap=\"true\"/>"));
  const Outcome there = converted(tree(ours, "Check", "<SubTree ID=\"S\" n=\"3\" way=\"{go}\"/>"));
  CHECK(there.code == 0);
  CHECK(contains(there.err, "warning: for BehaviorTree.CPP, 'go' of this SubTree is 'yes'"));
  CHECK_FALSE(contains(there.err, "'n' of this SubTree"));
}

TEST_CASE("convert warns of keys with '_' in front that a SubTree passes on in one language only") {
  const TemporaryDirectory directory;
  const auto tree = [](bool is_ours, const std::string& outer, const std::string& inner,
                       const std::string& subtree = "<SubTree ID=\"S\" _autoremap=\"true\"/>") {
    return std::string("<root ") + (is_ours ? "lockstep=\"1\"" : "BTCPP_format=\"4\"") +
           " main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><Sequence>" + outer + subtree +
           "</Sequence></BehaviorTree><BehaviorTree ID=\"S\"><Inverter><Inverter>" + inner +
           "</Inverter></Inverter></BehaviorTree></root>";
  };
  const auto script = [](const std::string& code) { return "<Script code=\"" + code + "\"/>"; };
  const std::string is_told = "warning: '_autoremap' is not quite the same for ";
  for (const bool is_ours : {true, false}) {
    const auto told = [&](auto... parts) {
      return run_lockstep({"convert", directory.file("tree.xml", tree(is_ours, parts...))}).err;
    };
    const std::string both = told(script("_p := 1"), script("_p := 5"));
    INFO(both);
    CHECK(contains(both, is_told + "'_p'"));
    CHECK(contains(told(script("_p := 1"), std::string("<Say text=\"{_p}\"/>")), is_told));
    CHECK(contains(told(std::string(), script("_p := 5"),
                        std::string("<SubTree ID=\"S\" _autoremap=\"1\"/>"
                                    "<SubTree ID=\"S\" name=\"t\" _autoremap=\"1\"/>")),
                   is_told));
    // Of one tree alone, and not passed on.
    CHECK_FALSE(contains(told(script("p := 1"), script("_p := 5")), is_told));
    CHECK_FALSE(contains(told(script("_p := 1"), script("_p := 5"),
                              std::string("<SubTree ID=\"S\" _autoremap=\"false\"/>")),
                         is_told));
    CHECK_FALSE(contains(told(script("p := 1"), script("p := 5")), is_told));
  }
  // By way of a tree between them, too.
  std::string deep = tree(true, script("_p := 1"), "<SubTree ID=\"T\" _autoremap=\"true\"/>");
  deep.insert(deep.find("</root>"),
              "<BehaviorTree ID=\"T\">" + script("_p := 5") + "</BehaviorTree>");
  const std::string err = run_lockstep({"convert", directory.file("deep.xml", deep)}).err;
  CHECK(err.find(is_told) != err.rfind(is_told));
}

TEST_CASE("convert warns of a property, which a tree for BehaviorTree.CPP cannot declare") {
  const TemporaryDirectory directory;
  const std::string file = directory.file(
      "tree.xml",
      R"(<root lockstep="1"><property name="p">never a.failure</property><BehaviorTree ID="M"><Wait name="a" seconds="1"/></BehaviorTree></root>)");
  const Outcome outcome = run_lockstep({"convert", file});
  CHECK(outcome.code == 0);
  CHECK_FALSE(contains(outcome.out, "property"));
  CHECK(contains(outcome.err, "warning: 'property' is left out [not-the-same]"));
  CHECK(contains(outcome.err, "--property"));
}
