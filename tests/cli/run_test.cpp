#include <catch2/catch.hpp>
#include <map>
#include <regex>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

const std::string kSynchronized =
    "<ParallelAbsolute name=\"pull\" barriers=\"0.5;1\">"
    "<Advance name=\"arm\" step=\"0.01\" noise=\"0.005\"/>"
    "<Advance name=\"base\" step=\"0.03\" noise=\"0.005\"/></ParallelAbsolute>";

// A run on the virtual clock.
struct Simulation {
  explicit Simulation(const std::string& node)
      : file(directory.file("tree.xml", tree_text(node))) {}

  Outcome run(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"run", file, "--clock", "virtual"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lockstep(arguments);
  }

  TemporaryDirectory directory;
  std::string file;
};

}  // namespace

TEST_CASE("an option that wants a number refuses one that is none") {
  const Simulation it("<AlwaysSuccess/>");
  for (const std::string option :
       {"--rate", "--timeout", "--stall", "--tick-budget", "--hang-limit"}) {
    for (const std::string number : {"nan", "-1", "inf", "fast"}) {
      const Outcome outcome = it.run({option, number});
      INFO(option << ' ' << number);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, option));
    }
  }
}

TEST_CASE("Success is 0 and Failure is 1") {
  CHECK(Simulation("<AlwaysSuccess/>").run().code == 0);
  CHECK(Simulation("<AlwaysFailure/>").run().code == 1);
}

TEST_CASE(
    "the summary goes to stdout, what happens meanwhile to stderr, without escape sequences") {
  const Simulation it(kSynchronized);
  const Outcome outcome = it.run({"--view", "auto"});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "success after"));
  CHECK(contains(outcome.out, "progress distance"));
  CHECK(contains(outcome.err, "Main/pull/base: waits for arm at barrier 0.5"));
  CHECK(!contains(outcome.out + outcome.err, "\x1b"));
  CHECK(it.run({"--view", "plain"}).err == outcome.err);
  const Outcome silent = it.run({"--view", "none"});
  CHECK(silent.err.empty());
  CHECK(silent.out == outcome.out);
}

TEST_CASE("run --json is the summary as one object on stdout") {
  const Outcome outcome = Simulation(kSynchronized).run({"--json"});
  const json summary = parse_json(outcome.out);
  CHECK(summary["result"] == "success");
  CHECK(summary["reason"] == "completed");
  CHECK(summary["ticks"] > 5);
  CHECK(summary["synchronized_nodes"].size() == 1);
}

TEST_CASE("run --max-ticks and --timeout end with 124, all running leaves halted") {
  const Simulation it("<Parallel><AlwaysRunning/><Advance step=\"0\"/></Parallel>");
  const Outcome ticks = it.run({"--max-ticks", "7"});
  CHECK(ticks.code == 124);
  CHECK(contains(ticks.out, "after 7 ticks"));
  CHECK(contains(ticks.err, "Main/Parallel/Advance: halted"));
  const Outcome time = it.run({"--timeout", "0.5", "--rate", "10"});
  CHECK(time.code == 124);
  CHECK(contains(time.out, "after 5 ticks"));
}

TEST_CASE("on the virtual clock a tree that never completes is stopped after a million ticks") {
  const Outcome outcome = Simulation("<AlwaysRunning/>").run();
  CHECK(outcome.code == 124);
  CHECK(outcome.out.starts_with(
      "stopped: the tick limit (--max-ticks) was reached after 1000000 ticks, 10000.000 s"));
  const Outcome longer = Simulation("<AlwaysRunning/>").run({"--timeout", "10001"});
  CHECK(longer.out.starts_with(
      "stopped: the time limit (--timeout) was reached after 1000100 ticks, 10001.000 s"));
}

TEST_CASE("a value that a built-in node does not take is a fault that names node, entry, value") {
  const Simulation it(
      "<ParallelRelative name=\"pair\" delta=\"{delta}\"><Advance step=\"0.1\"/>"
      "</ParallelRelative>");
  const Outcome outcome = it.run({"--set", "delta=1.5"});
  CHECK(outcome.code == 5);
  CHECK(
      contains(outcome.err,
               "the node 'Main/pair' (ParallelRelative) failed in tick 0 at 0.000 s: 1.5 is "
               "outside the range of 'delta': 'delta' is '1.5', from the entry '{delta}'; it must "
               "be from 0 to 1"));
  CHECK(it.run({"--set", "delta=0.5"}).code == 0);
}

TEST_CASE("run --rate is ticks per second") {
  const Outcome outcome = Simulation("<Wait seconds=\"1\"/>").run({"--rate", "20", "--json"});
  CHECK(parse_json(outcome.out)["ticks"] == 21);
}

TEST_CASE("run --arg, --set and --tree choose what runs") {
  const TemporaryDirectory directory;
  const std::string file = directory.file(
      "tree.xml",
      "<root lockstep=\"1\" main_tree_to_execute=\"A\"><plugin name=\"motion\"/>"
      "<arg name=\"n\" default=\"1\"/>"
      "<BehaviorTree ID=\"A\"><Repeat times=\"${n}\"><AlwaysSuccess/></Repeat></BehaviorTree>"
      "<BehaviorTree ID=\"B\"><Advance step=\"{pace}\"/></BehaviorTree></root>");
  const auto ticks = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"run", file, "--clock", "virtual", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return parse_json(run_lockstep(arguments).out)["ticks"].get<int>();
  };
  CHECK(ticks({}) == 1);
  CHECK(ticks({"--arg", "n=3"}) == 3);
  CHECK(ticks({"--tree", "B", "--set", "pace=0.25"}) == 4);
}

TEST_CASE("the same seed gives the same run, another seed another") {
  const Simulation it(kSynchronized);
  const auto recorded = [&](const std::string& seed) {
    const std::string file = it.directory.path("run.jsonl");
    REQUIRE(it.run({"--seed", seed, "--record", file}).code == 0);
    const std::string text = read_file(file);
    return text.substr(text.find('\n'));  // the header names the seed
  };
  CHECK((recorded("7") == recorded("7")));
  CHECK((recorded("7") != recorded("8")));
}

TEST_CASE("a recording holds the whole run: header, ticks, end") {
  const Simulation it(kSynchronized);
  const std::string file = it.directory.path("run.jsonl");
  const Outcome outcome = it.run({"--record", file, "--seed", "3", "--json"});
  const auto recording = lines(read_file(file));
  const json summary = parse_json(outcome.out);
  REQUIRE(recording.size() == summary["ticks"].get<std::size_t>() + 2);
  const json header = parse_json(recording.front());
  CHECK(header["seed"] == 3);
  CHECK(header["clock"] == "virtual");
  CHECK(header["file"] == it.file);
  CHECK(header["nodes"][1]["path"] == "Main/pull/arm");
  const json end = parse_json(recording.back())["end"];
  CHECK(end["reason"] == "completed");
  CHECK(end["ticks"] == summary["ticks"]);
}

TEST_CASE("a whole number is taken as it is written, or refused") {
  const Simulation it("<AlwaysSuccess/>");
  const std::string file = it.directory.path("run.jsonl");
  const auto seed = [&](const std::string& text) {
    REQUIRE(it.run({"--seed", text, "--record", file}).code == 0);
    return parse_json(lines(read_file(file)).front())["seed"].get<std::uint64_t>();
  };
  CHECK(seed("18446744073709551615") == 18446744073709551615u);
  CHECK(seed("010") == 10);
  CHECK(contains(it.run({"--seed", "18446744073709551616"}).err,
                 "--seed: '18446744073709551616' is more than 18446744073709551615"));
}

TEST_CASE("a recording that cannot be opened stops the run before it begins") {
  const Outcome outcome =
      Simulation("<AlwaysSuccess/>").run({"--record", "/nonexistent/run.jsonl"});
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, "/nonexistent/run.jsonl"));
}

TEST_CASE("run --stall names who stands still while others wait") {
  const Simulation it(
      "<ParallelRelative name=\"pair\" delta=\"0.1\"><Advance name=\"arm\" step=\"0\"/>"
      "<Advance name=\"base\" step=\"0.3\"/></ParallelRelative>");
  const auto err = [&](const std::string& stall) {
    return it.run({"--stall", stall, "--max-ticks", "500", "--view", "none"}).err;
  };
  CHECK(contains(err("2"), "warning: Main/pair/arm makes no progress at 0 "));
  CHECK(err("0").empty());
  CHECK(err("10").empty());
}

TEST_CASE("who stood still is in the notes of the summary") {
  const Simulation it(
      "<ParallelRelative name=\"pair\" delta=\"0.1\"><Advance name=\"arm\" step=\"0\"/>"
      "<Advance name=\"base\" step=\"0.3\"/></ParallelRelative>");
  const Outcome outcome =
      it.run({"--stall", "2", "--max-ticks", "500", "--view", "none", "--json"});
  const json notes = parse_json(outcome.out)["notes"];
  REQUIRE(notes.size() == 1);
  CHECK(outcome.err == "warning: " + notes[0].get<std::string>() + "\n");
  CHECK(contains(it.run({"--stall", "2", "--max-ticks", "500", "--view", "none"}).out,
                 "note: Main/pair/arm makes no progress at 0 "));
}

TEST_CASE(
    "run --stall names a child that moves and gets nowhere, and notes that its progress fell") {
  const Simulation it(
      "<ParallelAbsolute name=\"pull\" barriers=\"0.8\"><Sequence name=\"again\">"
      "<Advance step=\"0.5\"/><Advance step=\"0.01\"/></Sequence>"
      "<Advance name=\"base\" step=\"0.1\"/></ParallelAbsolute>");
  const Outcome outcome = it.run({"--stall", "2", "--max-ticks", "500", "--view", "none"});
  CHECK(contains(outcome.err,
                 "warning: Main/pull/again moves, but is at 0.25 and has not come "
                 "beyond 0.505 since 0.080 s, and holds the other children"));
  CHECK(contains(outcome.out,
                 "note: the progress of 'Main/pull/again' fell, first at 0.030 s: the "
                 "spread has no bound then\n"));
  CHECK_FALSE(contains(outcome.out, "(bound"));
}

TEST_CASE("what leaves log, by --log-level, limited in every view") {
  const Simulation it("<Probe/>");
  const auto logged = [&](const std::string& view, std::vector<std::string> more) {
    more.insert(more.end(),
                {"--view", view, "--plugin", LOCKSTEP_BINARY_DIR "/tests/cli/chatty.so"});
    std::map<std::string, int> count;
    for (const std::string& line : lines(it.run(more).err)) {
      for (const char* level : {"debug: thinks", "info: works", "warning: worries", "left out"}) {
        if (contains(line, level)) ++count[level];
      }
    }
    return count;
  };
  for (const std::string view : {"none", "plain"}) {
    INFO(view);
    const auto all = logged(view, {"--log-level", "debug"});
    const int shown = all.at("debug: thinks") + all.at("info: works") + all.at("warning: worries");
    CHECK(shown >= 190);  // create, start and the like come before
    CHECK(shown < 250);   // after the burst one a second
    CHECK(all.at("left out") > 0);
    const auto info = logged(view, {});
    CHECK(info.count("debug: thinks") == 0);
    CHECK(info.at("info: works") > 0);
    const auto warning = logged(view, {"--log-level", "warning"});
    CHECK(warning.count("info: works") == 0);
    CHECK(warning.at("warning: worries") >= 200);
    CHECK(logged(view, {"--log-level", "none"}).empty());
  }
  CHECK(it.run({"--log-level", "error"}).code == 2);
}

TEST_CASE("wrong usage is 2 and runs nothing") {
  const Simulation it("<AlwaysSuccess/>");
  const std::vector<std::string> rows[] = {
      {"--rate", "0"},     {"--rate", "1e9"},   {"--rate", "fast"},   {"--clock", "sundial"},
      {"--seed", "-1"},    {"--seed", "1.5"},   {"--max-ticks", "0"}, {"--max-ticks", "-3"},
      {"--timeout", "-1"}, {"--stall", "-1"},   {"--view", "3d"},     {"--set", "x"},
      {"--set", "none=1"}, {"--arg", "none=1"}, {"--tree", "None"},   {"other.xml"},
      {"--no-such-option"}};
  for (const auto& row : rows) {
    const Outcome outcome = it.run(row);
    INFO(row[0] << " " << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(!outcome.err.empty());
  }
  CHECK(run_lockstep({"run"}).code == 2);
}

TEST_CASE("an invalid tree is 3, a refused plugin 4") {
  CHECK(Simulation("<Sequnce/>").run().code == 3);
  const Simulation it("<Probe/>");
  const Outcome abi = it.run({"--plugin", abi_plugin("wrong_abi")});
  CHECK(abi.code == 4);
  CHECK(contains(abi.err, "wrong_abi.so"));
  CHECK(it.run({"--plugin", abi_plugin("init_refuses")}).code == 4);
  CHECK(it.run({"--plugin", abi_plugin("good")}).code == 0);
}

TEST_CASE("a leaf that fails as a program is 5, it is named, the others are halted") {
  for (const std::string name : {"error_in_tick", "throws_exception", "status_out_of_range",
                                 "nan_progress", "condition_running"}) {
    const Simulation it(
        "<ParallelRelative delta=\"1\"><Advance name=\"arm\"/><Probe name=\"culprit\"/>"
        "</ParallelRelative>");
    const Outcome outcome = it.run({"--plugin", abi_plugin(name)});
    INFO(name << "\n" << outcome.err);
    CHECK(outcome.code == 5);
    CHECK(contains(outcome.err, "Main/ParallelRelative/culprit"));
    CHECK(contains(outcome.err, "plugin '" + name + "'"));
    CHECK(contains(outcome.err, "in tick "));
    CHECK(contains(outcome.err, "Main/ParallelRelative/arm: halted"));
  }
  const Outcome fault = Simulation("<Profile shape=\"zigzag\"/>").run({"--json"});
  CHECK(fault.code == 5);
  CHECK(parse_json(fault.out)["reason"] == "fault");
}

TEST_CASE("a port whose entry nobody has written has its default, or the fault names the entry") {
  const TemporaryDirectory directory;
  const std::string head =
      "<root lockstep=\"1\"><plugin name=\"motion\"/><plugin name=\"fetch\"/>"
      "<BehaviorTree ID=\"Main\">";
  const std::string tail = "</BehaviorTree></root>";
  const std::string bound =
      directory.file("bound.xml", head + "<Advance step=\"{s}\" noise=\"{n}\"/>" + tail);
  const std::string plain = directory.file("plain.xml", head + "<Advance/>" + tail);
  const std::string unwritten =
      directory.file("unwritten.xml", head + "<Say text=\"{words}\"/>" + tail);
  const auto run_tree = [](const std::string& tree, std::vector<std::string> more) {
    more.insert(more.begin(), {"run", tree, "--clock", "virtual", "--json", "--view", "none"});
    return run_lockstep(more);
  };
  const auto ticks = parse_json(run_tree(plain, {}).out)["ticks"];
  for (const auto& more : {std::vector<std::string>{}, std::vector<std::string>{"--isolate"}}) {
    const Outcome with_default = run_tree(bound, more);
    CHECK(with_default.code == 0);
    CHECK(parse_json(with_default.out)["ticks"] == ticks);
    const Outcome without = run_tree(unwritten, more);
    CHECK(without.code == 5);
    CHECK(
        contains(without.err, "port 'text' has no value: nothing has written the entry '{words}'"));
  }
}

TEST_CASE("a fault is reported once in words and once in the summary") {
  const Simulation it("<Parallel><Probe name=\"culprit\"/></Parallel>");
  const auto times = [](const std::string& text) {
    const std::regex words("threw an exception");
    return std::distance(std::sregex_iterator(text.begin(), text.end(), words), {});
  };
  for (const std::string view : {"plain", "none"}) {
    const Outcome outcome = it.run({"--plugin", abi_plugin("throws_exception"), "--view", view});
    INFO(outcome.err);
    CHECK(times(outcome.out) == 1);
    CHECK(times(outcome.err) == 1);
    CHECK(contains(outcome.err, "lockstep: error: the leaf 'Main/Parallel/culprit' (Probe of "));
  }
}

TEST_CASE("run notes a synchronized node whose leaves report no progress") {
  const std::vector<std::string> probe{"--plugin",    LOCKSTEP_BINARY_DIR "/tests/cli/chatty.so",
                                       "--max-ticks", "1",
                                       "--view",      "none",
                                       "--log-level", "none"};
  const Outcome outcome =
      Simulation(
          "<ParallelAbsolute name=\"both\" barriers=\"0.5\"><Timeout seconds=\"9\"><Probe "
          "name=\"arm\"/></Timeout><Advance/></ParallelAbsolute>")
          .run(probe);
  CHECK(contains(outcome.err,
                 "tree.xml: note: the children of 'Main/both' are in step, but these "
                 "report no progress and are at 0 until they succeed: 'arm' [no-progress]\n"));
  for (const std::string node :
       {"<ParallelAbsolute barriers=\"0.5\"><Advance/><Advance/></ParallelAbsolute>",
        "<Parallel><Probe/><Advance/></Parallel>",
        "<ParallelAbsolute barriers=\"0.5\"><Sequence><Probe/></Sequence><Advance/>"
        "</ParallelAbsolute>"}) {
    CHECK(Simulation(node).run(probe).err == "");
  }
}

TEST_CASE("the result of a run that a fault ended is fault, whatever its siblings returned") {
  const Simulation it(
      "<Parallel success_count=\"1\"><AlwaysSuccess/><Probe name=\"culprit\"/></Parallel>");
  const Outcome text = it.run({"--plugin", abi_plugin("throws_exception")});
  CHECK(text.code == 5);
  CHECK(text.out.starts_with("fault after 1 tick, 0.010 s: Main/Parallel/culprit: threw an"));
  CHECK(contains(text.err, "run ends: fault after 1 tick"));
  const std::string recording = it.directory.path("run.jsonl");
  const Outcome outcome =
      it.run({"--plugin", abi_plugin("throws_exception"), "--json", "--record", recording});
  CHECK(parse_json(outcome.out)["result"] == "fault");
  CHECK(parse_json(outcome.out)["reason"] == "fault");
  const json end = parse_json(lines(read_file(recording)).back())["end"];
  CHECK(end["result"] == "fault");
  CHECK(end["reason"] == "fault");
  CHECK(contains(run_lockstep({"log", "info", recording}).out, "  fault after 1 tick"));
}

TEST_CASE("a terminal gets the live view, in color unless NO_COLOR asks for none") {
  const TemporaryDirectory directory;
  const std::string file =
      directory.file("tree.xml", tree_text("<Parallel><Advance step=\"0.02\"/></Parallel>"));
  const std::regex color("\x1b\\[[0-9;]*m");
  for (const bool no_color : {false, true}) {
    Invocation call{.arguments = {"run", file, "--rate", "100"}};
    if (no_color) call.environment["NO_COLOR"] = "1";
    const Outcome outcome = Process(call, Process::Output::Terminal).finish();
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "after 50 ticks"));
    CHECK(contains(outcome.out, "\x1b[?25l"));  // the cursor is hidden, and comes back
    CHECK(outcome.out.rfind("\x1b[?25h") > outcome.out.rfind("\x1b[?25l"));
    CHECK(std::regex_search(outcome.out, color) != no_color);
  }
  const Outcome plain =
      Process({.arguments = {"run", file, "--view", "plain"}, .environment = {{"NO_COLOR", "1"}}},
              Process::Output::Terminal)
          .finish();
  CHECK(!contains(plain.out, "\x1b"));
}
