// Names and texts of trees, plugins, recordings and the command line never reach a terminal raw:
// not as text, in the live view, in a replay, in JSON, nor in a message of what is wrong with them.
#include <catch2/catch.hpp>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

using Strings = std::vector<std::string>;
using nlohmann::json;

const std::string kPlugins = LOCKSTEP_BINARY_DIR "/tests/cli/";

// U+009B is ESC [ in one character, U+202E turns the text behind it around; what XML lets in.
const std::string kEvil = "\u009b31m\u0085\u007f\u202egpj.\u2066\u200f";
// JSON lets all in.
const std::string kWorse = "\x1b]2;title\x07\x1b[2J\r\b" + kEvil;

// `text` without line ends and what lockstep itself sends to a terminal.
std::string without_our_own(const std::string& text) {
  std::string rest;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text.compare(at, 2, "\x1b[") == 0) {
      const auto last = text.find_first_not_of("0123456789;?", at + 2);
      if (last != std::string::npos &&
          std::string("mKJAhl").find(text[last]) != std::string::npos) {
        at = last;
        continue;
      }
    }
    if (text[at] != '\n' && text[at] != '\r') rest += text[at];
  }
  return rest;
}

bool is_clean(const std::string& text, bool on_terminal = false) {
  std::string rest = text;
  std::erase(rest, '\n');
  if (on_terminal) rest = without_our_own(text);
  return printable(rest) == rest;
}

void check_clean(const Outcome& outcome, const std::string& what, bool on_terminal = false) {
  INFO(what << '\n' << printable(outcome.out) << '\n' << printable(outcome.err));
  CHECK(is_clean(outcome.out, on_terminal));
  CHECK(is_clean(outcome.err, on_terminal));
  CHECK(outcome.out.size() + outcome.err.size() > 0);
  CHECK(outcome.code < 128);
}

void check_all(const std::vector<Strings>& commands) {
  for (const Strings& command : commands) {
    check_clean(run_lockstep(command), joined(command, " "));
  }
}

std::string root(const std::string& rest) {
  return "<root lockstep=\"1\" main_tree_to_execute=\"A\">\n" + rest + "</root>";
}
std::string in_tree(const std::string& nodes) {
  return root("<BehaviorTree ID=\"A\">" + nodes + "</BehaviorTree>");
}

const std::string kGood =
    in_tree("<ParallelAbsolute barriers=\"0.5\" name=\"" + kEvil + "\"><AlwaysSuccess name=\"a" +
            kEvil + "\"/><Wait seconds=\"0.02\" name=\"b" + kEvil + "\"/></ParallelAbsolute>");

// A recording in which every text is evil.
std::string recording() {
  const json node = {{"index", 0},     {"path", "T/" + kWorse}, {"kind", kWorse},
                     {"name", kWorse}, {"parent", nullptr},     {"barriers", {0.5}}};
  const json child = {
      {"index", 1}, {"path", "T/x/" + kWorse}, {"kind", kWorse}, {"name", kWorse}, {"parent", 0}};
  const json header = {{"lockstep_recording", 1},
                       {"tree", kWorse},
                       {"file", kWorse},
                       {"version", kWorse},
                       {"rate_hz", 10},
                       {"clock", kWorse},
                       {"seed", 1},
                       {"arguments", {{kWorse, kWorse}}},
                       {"nodes", {node, child}}};
  const json tick = {{"tick", 0},
                     {"time_s", 0},
                     {"nodes", {{0, "running", 0.5, 1, 0}, {1, "running", 0.5, 0, 1}}},
                     {"faults", json::array({json::array({1, kWorse})})}};
  const json end = {{"end",
                     {{"result", kWorse},
                      {"reason", kWorse},
                      {"fault", kWorse},
                      {"ticks", 1},
                      {"time_s", 0.1},
                      {"overruns", 0},
                      {"skipped", 0}}}};
  return header.dump() + "\n" + tick.dump() + "\n" + end.dump() + "\n";
}

}  // namespace

TEST_CASE("texts of a tree reach the terminal visible, whatever is done with it") {
  const TemporaryDirectory directory;
  const std::string good = directory.file("good.xml", kGood);
  const std::string file = directory.path("run.jsonl");
  const auto wrong = [&](const std::string& name, const std::string& text) {
    return Strings{"check", directory.file(name + ".xml", text)};
  };
  check_all({
      {"check", good},
      {"check", good, "--format", "json", "--tree", kEvil},
      {"show", good},
      {"show", good, "--format", "dot"},
      {"show", good, "--format", "mermaid"},
      {"run", good, "--view", "plain", "--clock", "virtual", "--record", file},
      {"run", good, "--view", "plain", "--clock", "virtual", "--json"},
      {"run", good, "--view", "plain", "--max-ticks", "2"},
      {"log", "info", file},
      {"log", "measure", file},
      {"replay", file},
      wrong("unknown", in_tree("<Sequence x='" + kEvil + "' name='" + kEvil + "'/>")),
      wrong("id", in_tree("<" + kEvil + "/>")),
      wrong("plugin", root("<plugin name='" + kEvil + "'/>")),
      wrong("include", root("<include path='" + kEvil + "'/>")),
      wrong("subtree", in_tree("<SubTree ID='" + kEvil + "'/>")),
      wrong("key", in_tree("<Wait seconds='{" + kEvil + "}'/>")),
      wrong("argument",
            root("<arg name='" + kEvil + "'/><arg name='a' default='${" + kEvil + "}'/>")),
      wrong("raw", in_tree("<Wait seconds='\x1b[2J'/>")),
      wrong("\x1b[31mname\x07", "<root>"),
      wrong(kEvil, kGood),
  });
  // On a terminal: the live view, and what it prints above.
  for (const std::string locale : {"C", "C.UTF-8"}) {
    const Invocation call{.arguments = {"run", good, "--view", "live", "--max-ticks", "3"},
                          .environment = {{"LC_ALL", locale}}};
    check_clean(Process(call, Process::Output::Terminal).finish(), "live view", true);
  }
}

TEST_CASE("texts of what is reported while a tree runs reach the terminal visible") {
  const TemporaryDirectory directory;
  const std::string stands = directory.file(
      "stands.xml", tree_text("<ParallelAbsolute barriers=\"0.5\"><Advance name=\"a" + kEvil +
                              "\" step=\"0\"/><Advance name=\"b" + kEvil +
                              "\" step=\"0.3\"/></ParallelAbsolute>"));
  const auto run = [&](const std::string& view) {
    return Invocation{
        .arguments = {"run", stands, "--view", view, "--stall", "0.01", "--max-ticks", "9"}};
  };
  for (const std::string view : {"plain", "none", "live"}) {
    const Outcome piped = lockstep::host::test::run(run(view));
    CHECK(contains(piped.err, "makes no progress"));
    check_clean(piped, view, view == "live");
    const Outcome shown = Process(run(view), Process::Output::Terminal).finish();
    CHECK(contains(shown.out, "makes no progress"));
    check_clean(shown, view + " on a terminal", true);
  }
}

TEST_CASE("a character that changes the direction of text is shown as what it is") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml", in_tree("<AlwaysSuccess name=\"safe\u202elamina\"/>"));
  CHECK(contains(run_lockstep({"show", tree}).out, "safe\\u202Elamina"));
  const std::string legal =
      directory.file("legal.xml", in_tree("<AlwaysSuccess name=\"שלום é 漢\"/>"));
  CHECK(contains(run_lockstep({"show", legal}).out, "'שלום é 漢'"));
}

TEST_CASE("texts of the command line reach the terminal visible") {
  const TemporaryDirectory directory;
  const std::string good = directory.file("good.xml", kGood);
  check_all({{"check", kWorse + "nowhere.xml"},
             {"check", good, "--tree", kWorse},
             {"check", good, "--arg", kWorse + "=1"},
             {"check", good, "--arg", kWorse},
             {"check", good, "--set", kWorse + "=1"},
             {"check", good, "--plugin", kWorse},
             {"check", good, "--plugin", "./" + kWorse + ".so"},
             {"check", good, "--format", kWorse},
             {kWorse},
             {"run", good, "--" + kWorse},
             {"run", good, "--rate", kWorse},
             {"run", good, "--record", directory.path(kWorse + "/x")},
             {"nodes", kWorse},
             {"nodes", "--plugin", kWorse},
             {"schema", "--plugin", kWorse},
             {"log", kWorse},
             {"log", "info", kWorse},
             {"log", "diff", kWorse, kWorse},
             {"log", "measure", kWorse},
             {"log", "measure", good, "--measure", kWorse},
             {"log", "plot", good, "--out", kWorse},
             {"replay", kWorse},
             {"replay", good, "--at", kWorse},
             {"study", good, "--runs", "1", "--grid", kWorse},
             {"study", good, "--runs", "1", "--measure", kWorse},
             {"study", good, "--runs", "1", "--out", good + "/" + kWorse}});
}

TEST_CASE("texts of a plugin reach the terminal visible") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", in_tree("<Probe/>"));
  const std::string leaf = kPlugins + "loud_leaf.so";
  const Strings run = {"run", tree, "--plugin", leaf, "--clock", "virtual"};
  const auto with = [&](Strings more) {
    more.insert(more.begin(), run.begin(), run.end());
    return more;
  };
  const std::string file = directory.path("run.jsonl");
  check_all({with({"--view", "plain"}),
             with({"--view", "none", "--json"}),
             with({"--view", "plain", "--isolate"}),
             with({"--view", "plain", "--on-fault", "fail", "--record", file}),
             {"log", "info", file},
             {"replay", file},
             {"nodes", "--plugin", leaf},
             {"nodes", "Probe", "--plugin", leaf},
             {"nodes", "--format", "json", "--plugin", leaf},
             {"nodes", "--format", "markdown", "--plugin", leaf},
             {"schema", "--plugin", leaf},
             {"check", tree, "--plugin", kPlugins + "loud_name.so"},
             {"check", tree, "--plugin", kPlugins + "loud_name.so", "--isolate"},
             {"run", tree, "--plugin", kPlugins + "loud_init.so"},
             {"run", tree, "--plugin", kPlugins + "loud_init.so", "--isolate"}});
  for (const Strings& command : {with({"--view", "live"}), with({"--view", "plain"})}) {
    const Outcome outcome = Process({.arguments = command}, Process::Output::Terminal).finish();
    check_clean(outcome, "on a terminal", true);
    CHECK(contains(outcome.out, "logs \\x1B]2;loud\\x07 \\u009B31m \\u202E loud"));
    CHECK(contains(outcome.out, "fails \\x1B]2;loud\\x07 \\u009B31m \\u202E loud"));
  }
}

TEST_CASE("texts of a recording reach the terminal visible") {
  const TemporaryDirectory directory;
  const std::string text = recording();
  const std::string file = directory.file("run.jsonl", text);
  std::string changed = text;
  changed.replace(changed.find("\"seed\":1"), 8, "\"seed\":2");
  changed.replace(changed.find("0.5,0,1]"), 8, "0.6,0,1]");
  const std::string other = directory.file("other" + kWorse, changed);
  const auto broken = [&](const std::string& from, const std::string& to) {
    std::string wrong = text;
    wrong.replace(wrong.find(from), from.size(), to);
    return Strings{"log", "info", directory.file(kWorse + from, wrong)};
  };
  check_all({{"log", "info", file},
             {"log", "measure", file},
             {"log", "measure", file, "--json"},
             {"log", "measure", file, "--measure", "predictability:" + kWorse + "@0.5"},
             {"log", "diff", file, other},
             {"log", "diff", file, other, "--json"},
             {"log", "diff", file, directory.file("empty" + kWorse, "")},
             {"log", "plot", file, "--out", directory.path("x.svg"), "--node", kWorse + "x"},
             {"log", "plot", file, "--out", directory.path(kWorse + ".svg")},
             {"replay", file},
             broken("\"seed\":1", "\"seed\":[]"),
             broken("\"running\"", json(kWorse).dump())});
  for (const Strings& command : std::vector<Strings>{
           {"log", "csv", file}, {"log", "diff", file, other}, {"replay", file, "--print"}}) {
    check_clean(Process({.arguments = command}, Process::Output::Terminal).finish(), command[1],
                true);
  }
  Process replay({.arguments = {"replay", file}, .environment = {{"LC_ALL", "C.UTF-8"}}},
                 Process::Output::Terminal);
  REQUIRE(replay.wait_for("tick 0 of 0"));
  replay.type("q");
  check_clean(replay.finish(), "replay", true);
}

TEST_CASE("what programs read is exact: CSV in a pipe, and JSON as it parses") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("run.jsonl", recording());
  CHECK(contains(run_lockstep({"log", "csv", file}).out, "T/x/" + kWorse));
  const auto values = parse_json(run_lockstep({"log", "measure", file, "--json"}).out);
  CHECK(values[0]["node"] == "T/" + kWorse);
  const auto summary = parse_json(
      run_lockstep({"run", directory.file("good.xml", kGood), "--clock", "virtual", "--json"}).out);
  CHECK(summary["synchronized_nodes"][0]["path"] == "A/" + kEvil);
}

}  // namespace lockstep::host::test
