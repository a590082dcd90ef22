// Properties from outside: of a recording, of a run, of a tree file.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "base/core/random.h"
#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

// Arm and base are in step; the base is faster, so it is held. Ten ticks.
const char* const kPull =
    "<ParallelAbsolute name=\"pull\" barriers=\"0.5;1\"><Advance name=\"arm\" step=\"0.1\"/>"
    "<Advance name=\"base\" step=\"0.3\"/></ParallelAbsolute>";

Outcome run_tree(const std::string& tree, std::vector<std::string> more) {
  more.insert(more.begin(), {"run", tree, "--clock", "virtual", "--view", "none"});
  return run_lockstep(std::move(more));
}

std::string record(const TemporaryDirectory& directory, const std::string& node = kPull) {
  const std::string file = directory.path("run.jsonl");
  REQUIRE(run_tree(directory.file("tree.xml", tree_text(node)), {"--record", file}).code < 2);
  return file;
}

// The properties, each after its option.
std::vector<std::string> options(const std::vector<std::string>& properties) {
  std::vector<std::string> words;
  for (const std::string& it : properties) words.insert(words.end(), {"--property", it});
  return words;
}

Outcome check(const std::string& recording, const std::vector<std::string>& properties,
              const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = options(properties);
  words.insert(words.begin(), {"log", "check", recording});
  words.insert(words.end(), more.begin(), more.end());
  return run_lockstep(std::move(words));
}

std::string tree_with(const std::string& properties) {
  std::string text = tree_text(kPull);
  return text.insert(text.find("<BehaviorTree"), properties);
}

// [name, verdict, tick] of each.
json verdicts(const json& properties) {
  json list = json::array();
  for (const json& it : properties) {
    list.push_back({it.at("name"), it.at("verdict"), it.at("tick")});
  }
  return list;
}

}  // namespace

TEST_CASE("log check says of each property whether the recording satisfies it") {
  const TemporaryDirectory directory;
  const std::string recording = record(directory);
  const Outcome good = check(recording, {"in step: never base.progress > 0.7 and arm.idle"});
  CHECK(good.code == 2);  // a name with a blank needs quotes
  const Outcome outcome = check(
      recording, {"step: never arm.failure", "base.held at most 1 tick", "sometimes base.held"});
  CHECK(outcome.code == 1);
  CHECK(outcome.out ==
        "verdict   tick  property\n"
        "holds     -     step: never arm.failure\n"
        "violated  3     base.held at most 1 tick\n"
        "holds     2     sometimes base.held\n");
  CHECK(outcome.err.empty());
  CHECK(check(recording, {"never arm.failure"}).code == 0);
}

TEST_CASE("log check --json has the same in one line") {
  const TemporaryDirectory directory;
  const Outcome outcome =
      check(record(directory), {"h: base.held at most 1 tick", "never arm.failure"}, {"--json"});
  CHECK(outcome.code == 1);
  CHECK(parse_json(outcome.out) ==
        parse_json(R"([{"name":"h","property":"base.held at most 1 tick","verdict":"violated",
                         "tick":3},
                        {"name":"never arm.failure","property":"never arm.failure",
                         "verdict":"holds","tick":null}])"));
}

TEST_CASE("log check leaves open what a recording that was cut does not decide") {
  const TemporaryDirectory directory;
  const auto all = lines(read_file(record(directory)));
  std::string part;
  for (std::size_t i = 0; i < 4; ++i) part += all[i] + "\n";
  const std::string cut = directory.file("cut.jsonl", part);
  const Outcome outcome = check(cut, {"sometimes arm.success", "never arm.failure"});
  CHECK(outcome.code == 124);
  CHECK(contains(outcome.out, "open     -     sometimes arm.success\n"));
  CHECK(contains(outcome.out, "open     -     never arm.failure\n"));
}

TEST_CASE("log check: a mistake in a property is reported at its column") {
  const TemporaryDirectory directory;
  const std::string recording = record(directory);
  const Outcome outcome = check(recording, {"never arm.runing", "sometimes ar.running"});
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err,
                 "--property:1:11: error: a node has no 'runing' [bad-property]\n"
                 "  never arm.runing\n"
                 "            ^\n"
                 "  hint: did you mean 'running'?\n"));
  CHECK(contains(outcome.err, "--property:1:11: error: no node 'ar'"));
  CHECK(check(recording, {}).code == 2);
}

TEST_CASE("log check: a recording knows which entries hold values of their type only") {
  const TemporaryDirectory directory;
  const auto recorded = [&](const std::string& text) {
    const std::string tree = directory.file("tree.xml", text), file = directory.path("run.jsonl");
    REQUIRE(run_tree(tree, {"--record", file}).code == 0);
    return file;
  };
  const std::string script = "<BehaviorTree ID=\"Main\"><Script code=\"count := 3\"/>";
  const std::string wrong = "never {count} == '4'";
  const std::string strict = recorded("<root lockstep=\"1\">" + script + "</BehaviorTree></root>");
  const Outcome refused = check(strict, {wrong});
  CHECK(refused.code == 2);
  CHECK(contains(refused.err, "'count' is of the type int"));
  CHECK(contains(refused.err, "hint: compare it with a number"));
  // One of an earlier version does not tell.
  std::string older = read_file(strict);
  REQUIRE(contains(older, R"("strict":true,)"));
  older.replace(older.find(R"("strict":true,)"), 14, "");
  CHECK(check(directory.file("older.jsonl", older), {wrong}).code == 0);
  // In a tree for BehaviorTree.CPP, an entry may also get a text.
  const std::string theirs =
      recorded("<root BTCPP_format=\"4\">" + script + "</BehaviorTree></root>");
  CHECK(check(theirs, {wrong}).code == 0);
}

TEST_CASE("log check --property-file reads a property from each line") {
  const TemporaryDirectory directory;
  const std::string recording = record(directory);
  const std::string good = directory.file(
      "good.txt", "# of the door\n\ngrip: never arm.failure\n  sometimes arm.done\n");
  const Outcome outcome = check(recording, {}, {"--property-file", good});
  CHECK(outcome.code == 0);
  CHECK(lines(outcome.out).size() == 3);
  const std::string bad = directory.file("bad.txt", "never arm.failure\n\n  never arn.failure\n");
  const Outcome refused = check(recording, {}, {"--property-file", bad});
  CHECK(refused.code == 2);
  CHECK(contains(refused.err, bad + ":3:9: error: no node 'arn'"));
  const std::string none = directory.path("none.txt");
  CHECK(contains(check(recording, {}, {"--property-file", none}).err, none));
}

TEST_CASE("run --property tells a violation in its tick, records it and goes on") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kPull));
  const std::string file = directory.path("run.jsonl");
  const Outcome outcome =
      run_tree(tree, {"--property", "wait: base.held at most 1 tick", "--record", file, "--json"});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err,
                 "warning: property wait is violated in tick 3, at 0.030 s: base.held at most 1 "
                 "tick\n"));
  CHECK(verdicts(parse_json(outcome.out).at("properties")) ==
        parse_json(R"([["wait", "violated", 3]])"));
  const json tick = parse_json(lines(read_file(file)).at(4));
  CHECK(tick.at("tick") == 3);
  CHECK(tick.at("logs") == parse_json(R"([["property wait", "warning",
                         "violated in tick 3, at 0.030 s: base.held at most 1 tick"]])"));
}

TEST_CASE("run --on-violation end ends the run with exit code 10") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kPull));
  const std::string file = directory.path("run.jsonl");
  const Outcome outcome = run_tree(
      tree, {"--property", "base.held at most 1 tick", "--on-violation", "end", "--record", file});
  CHECK(outcome.code == 10);
  CHECK(contains(outcome.out, "stopped: a property is violated after 4 ticks"));
  const json end = parse_json(lines(read_file(file)).back()).at("end");
  CHECK(end.at("reason") == "property");
  CHECK(end.at("ticks") == 4);
}

TEST_CASE("run --on-violation end also counts what only the end shows") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kPull));
  const std::string file = directory.path("run.jsonl");
  const Outcome outcome = run_tree(
      tree, {"--property", "sometimes arm.failure", "--on-violation", "end", "--record", file});
  CHECK(outcome.code == 10);
  CHECK(contains(outcome.err,
                 "warning: property is violated at the end, after 10 ticks: "
                 "sometimes arm.failure\n"));
  const json end = parse_json(lines(read_file(file)).back()).at("end");
  CHECK(end.at("reason") == "completed");
  CHECK(end.at("logs").size() == 1);
  // A limit ends the run from outside: nothing is decided.
  const Outcome limited = run_tree(
      tree, {"--property", "sometimes arm.failure", "--on-violation", "end", "--max-ticks", "5"});
  CHECK(limited.code == 124);
  CHECK(contains(limited.out, "property   sometimes arm.failure: open\n"));
}

TEST_CASE("run --property refuses a mistake before the first tick") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kPull));
  const Outcome outcome = run_tree(tree, {"--property", "never arn.running"});
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, "--property:1:7: error: no node 'arn'"));
}

TEST_CASE("run checks the properties of the tree file, and then those of the options") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", tree_with("<property name=\"wait\">base.held at most\n  1 tick</property>"
                            "<property name=\"far\">never arm.progress &lt; 0.5 and "
                            "base.progress &gt; 0.8</property>"
                            "<property name=\"far2\"><![CDATA[never arm.progress < 0.1 and "
                            "'base'.progress > 0.5]]></property>"));
  CHECK(run_lockstep({"check", tree}).code == 0);
  const Outcome outcome = run_tree(tree, {"--json", "--property", "never pull.failure"});
  CHECK(verdicts(parse_json(outcome.out).at("properties")) ==
        parse_json(R"([["wait", "violated", 3], ["far", "holds", null], ["far2", "holds", null],
                        ["never pull.failure", "holds", null]])"));
  CHECK(contains(outcome.err, ": base.held at most 1 tick\n"));  // on one line
}

TEST_CASE("log check without options checks the properties of the tree file") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", tree_with("<property name=\"slow\">never base.progress &gt; 0.5</property>"
                            "<property name=\"ends\">sometimes pull.success</property>"));
  const std::string recording = directory.path("run.jsonl");
  REQUIRE(run_tree(tree, {"--record", recording}).code == 0);
  const Outcome declared = check(recording, {});
  CHECK(declared.code == 1);
  CHECK(declared.out ==
        "verdict   tick  property\n"
        "violated  2     slow: never base.progress > 0.5\n"
        "holds     9     ends: sometimes pull.success\n");

  const Outcome given = check(recording, {"sometimes arm.success"});  // this alone
  CHECK(given.code == 0);
  CHECK_FALSE(contains(given.out, "slow"));
  const Outcome both = check(recording, {"sometimes arm.success"}, {"--tree-file", tree});
  CHECK(both.code == 1);
  CHECK((contains(both.out, "slow") && contains(both.out, "arm.success")));
}

TEST_CASE("log check says where the properties of a tree file do not come from, or do not fit") {
  const TemporaryDirectory directory;
  const std::string recording = record(directory);
  const Outcome none = check(recording, {});
  CHECK(none.code == 2);
  CHECK(contains(none.err, "tree.xml has no <property>: give a --property"));
  const std::string other = directory.file(
      "other.xml",
      "<root lockstep=\"1\"><property name=\"it\">sometimes new.success</property>"
      "<BehaviorTree ID=\"Main\"><AlwaysSuccess name=\"new\"/></BehaviorTree></root>");
  const Outcome changed = check(recording, {}, {"--tree-file", other});
  CHECK(changed.code == 2);
  CHECK(contains(changed.err, "property 'it' of "));
  CHECK(contains(changed.err, "does not fit the recording"));
}

TEST_CASE("check reports a mistake in a property at its place in the tree file") {
  const TemporaryDirectory directory;
  const auto refused = [&](const std::string& property) {
    const std::string tree = directory.file("tree.xml", "<root lockstep=\"1\">\n" + property +
                                                            "\n<BehaviorTree ID=\"Main\">"
                                                            "<AlwaysSuccess name=\"arm\"/>"
                                                            "</BehaviorTree></root>");
    const Outcome outcome = run_lockstep({"check", tree});
    CHECK(outcome.code == 3);
    return outcome.err.substr(std::min(outcome.err.find("tree.xml"), outcome.err.size()));
  };
  CHECK(contains(refused("<property name=\"p\">never arm.runing</property>"),
                 "tree.xml:2:30: error: a node has no 'runing'"));
  CHECK(contains(
      refused("<property name=\"p\">never arm.progress &lt; 0.5\n  or arn.held</property>"),
      "tree.xml:3:6: error: no node 'arn'"));
  CHECK(contains(refused("<property name=\"p\">never arm.progress &lt; 1.5</property>"),
                 "tree.xml:2:44: error: progress is never 1.5"));
  CHECK(contains(refused("<property name=\"p\"><![CDATA[never arm.progress < 1.5]]></property>"),
                 "tree.xml:2:50: error: progress is never 1.5"));
  CHECK(contains(refused("<property>never arm.held</property>"),
                 "tree.xml:2:1: error: 'property' needs the attribute 'name'"));
  CHECK(
      contains(refused("<property name=\"p\"/>"), "tree.xml:2:1: error: the property has no text"));
  CHECK(contains(refused("<property name=\"a b\">never arm.held</property>"),
                 "tree.xml:2:17: error: 'a b' is not a name for 'property'"));
  CHECK(contains(refused("<property name=\"p\" x=\"1\">never arm.held</property>"),
                 "tree.xml:2:20: error: 'property' has no attribute 'x'"));
  CHECK(contains(refused("<property name=\"p\">never arm.held</property>"
                         "<property name=\"p\">never arm.held</property>"),
                 "error: a property 'p' exists already"));
  CHECK(contains(refused("<property name=\"p\">never <!-- - --> arm.held</property>"),
                 "error: a property has one text"));
  CHECK(contains(refused("<arg name=\"p\">text</arg>"), "text is not part of the language"));
  CHECK(contains(refused("<propertie name=\"p\"/>"), "did you mean 'property'?"));
}

TEST_CASE("the entries of a tree are compared alike in a run and in its recording") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml", tree_text("<Sequence><Script code=\"n := 1; place := 'kitchen'\"/>"
                                           "<Advance name=\"arm\" step=\"0.5\"/>"
                                           "<Script code=\"n = 3\"/></Sequence>"));
  const std::string file = directory.path("run.jsonl");
  const std::vector<std::string> properties = {"sometimes {n} == 3", "never {place} != 'kitchen'",
                                               "arm.running only after {n} >= 2"};
  std::vector<std::string> words = options(properties);
  words.insert(words.end(), {"--json", "--record", file});
  const Outcome live = run_tree(tree, words);
  const Outcome recorded = check(file, properties, {"--json"});
  const json expected = verdicts(parse_json(live.out).at("properties"));
  CHECK(verdicts(parse_json(recorded.out)) == expected);
  CHECK(expected[0][1] == "holds");
  CHECK(expected[1][1] == "holds");
  CHECK(expected[2][1] == "violated");
  // A recording without entries cannot say.
  run_tree(tree, {"--record", file, "--record-entries", "none"});
  const Outcome without = check(file, properties);
  CHECK(without.code == 2);
  CHECK(contains(without.err, "no entry 'n'"));
}

TEST_CASE("the examples of docs/properties.md hold for the door") {
  const std::string page = read_file(LOCKSTEP_SOURCE_DIR "/docs/properties.md");
  const auto begin = page.find("## Five examples");
  std::vector<std::string> words;
  for (const std::string& line : lines(page.substr(begin, page.find("\n## ", begin) - begin))) {
    if (!line.starts_with("| `")) continue;
    words.insert(words.end(), {"--property", line.substr(3, line.find('`', 3) - 3)});
  }
  REQUIRE(words.size() == 10);
  words.emplace_back("--json");
  const Outcome outcome = run_tree(LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml", words);
  INFO(outcome.err);
  const json summary = parse_json(outcome.out);
  for (const json& it : summary.at("properties")) {
    CHECK(it.at("verdict") == "holds");
  }
}

TEST_CASE("run --property and log check agree on random trees") {
  lockstep::host::RandomStream random(32, 0);
  const auto below = [&random](std::uint64_t end) { return random.next() % end; };
  const TemporaryDirectory directory;
  int violated = 0;
  for (int tree_number = 0; tree_number < 12; ++tree_number) {
    std::string nodes;
    const char* const parents[] = {"ParallelAbsolute barriers=\"0.3;0.6\"",
                                   "ParallelRelative delta=\"0.2\"", "Sequence", "Fallback",
                                   "Parallel"};
    for (const char* inner : {"p", "q"}) {
      const std::string parent = parents[below(5)];
      nodes += fmt::format(
          "<{} name=\"{}\">",
          parent.substr(0, parent.find(' ')) +
              (parent.find(' ') == std::string::npos ? "" : parent.substr(parent.find(' '))),
          inner);
      for (const char* leaf : {"a", "b"}) {
        nodes += fmt::format("<Advance name=\"{}{}\" step=\"0.{}\"/>", inner, leaf, 1 + below(5));
      }
      nodes += "</" + parent.substr(0, parent.find(' ')) + ">";
    }
    const std::string tree = directory.file(
        "tree.xml", tree_text(below(2) == 0 ? "<Sequence name=\"s\">" + nodes + "</Sequence>"
                                            : "<Parallel name=\"s\">" + nodes + "</Parallel>"));
    const auto term = [&] {
      const char* const kNodes[] = {"pa", "pb", "qa", "qb", "p", "q", "s"};
      const char* const kFields[] = {".running", ".success",         ".held",          ".idle",
                                     ".ticked",  ".progress < 0.35", ".progress > 0.6"};
      return std::string(kNodes[below(7)]) + kFields[below(7)];
    };
    std::vector<std::string> properties;
    for (int i = 0; i < 4; ++i) {
      properties.push_back("never " + term() + " and " + term());
      properties.push_back("sometimes " + term() + " and not " + term());
      properties.push_back(fmt::format("{} leads to {} within {} ticks", term(), term(), below(6)));
      properties.push_back(term() + " only after " + term());
      properties.push_back(fmt::format("{} at most {} ticks", term(), below(6)));
      properties.push_back(term() + " until " + term());
    }
    const std::string file = directory.path("run.jsonl");
    std::vector<std::string> words = options(properties);
    // Some of these trees have no end.
    const std::string ticks = tree_number % 3 == 0 ? "4" : "400";
    words.insert(words.end(), {"--json", "--record", file, "--max-ticks", ticks});
    const Outcome live = run_tree(tree, words);
    const Outcome recorded = check(file, properties, {"--json"});
    INFO(nodes << "\n" << live.err << recorded.err);
    const json expected = verdicts(parse_json(live.out).at("properties"));
    CHECK(verdicts(parse_json(recorded.out)) == expected);
    for (const json& it : expected) violated += it[1] == "violated" ? 1 : 0;
  }
  CHECK(violated > 20);
}
