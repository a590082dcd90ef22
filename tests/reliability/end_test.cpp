// What plugins do when they are loaded and when all is over, in every command: no command ends well
// before its work is done, and none ends without naming who kept it from ending.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "reliability/hostile_tree.h"
#include "support/json.h"

namespace lockstep::host::test {
namespace {

using nlohmann::json;
using Strings = std::vector<std::string>;

// Every command that loads plugins.
struct Commands {
  TemporaryDirectory directory;
  std::string tree = directory.file("tree.xml", hostile_tree({""}));
  std::string plugin = LOCKSTEP_HOSTILE_DIRECTORY "/hostile.so";
  std::vector<Strings> all = {{"check", tree},
                              {"show", tree},
                              {"run", tree, "--clock", "virtual", "--view", "none"},
                              {"nodes"},
                              {"schema"},
                              {"study", tree, "--runs", "3", "--measure", "duration", "--no-plots",
                               "--out", directory.path("study")}};
  // A study begins anew, whatever became of the one before.
  Outcome run_one(Strings arguments, std::map<std::string, std::string> environment) const {
    std::filesystem::remove_all(directory.path("study"));
    std::string how;
    for (const auto& [name, value] : environment) how += value;
    arguments.insert(arguments.end(), {"--plugin", plugin, "--hang-limit", hang_limit(how)});
    return run({.arguments = arguments, .environment = std::move(environment)});
  }
};

}  // namespace

TEST_CASE(
    "a plugin that crashes, hangs or calls exit while it is loaded is named in every command") {
  const Commands commands;
  for (const std::string how : {"segv", "hang", "exit", "_exit"}) {
    for (Strings arguments : commands.all) {
      INFO(arguments[0] << " " << how);
      const Outcome in_process = commands.run_one(arguments, {{"HOSTILE_LOAD", how}});
      INFO(in_process.err);
      CHECK(in_process.code == 6);
      CHECK(in_process.out.empty());
      CHECK(contains(in_process.err, "the plugin '" + commands.plugin + "'"));
      CHECK(contains(in_process.err, "the loading of its shared object"));
      arguments.emplace_back("--isolate");
      const Outcome isolated = commands.run_one(arguments, {{"HOSTILE_LOAD", how}});
      INFO(isolated.err);
      CHECK(isolated.code == 4);
      CHECK(contains(isolated.err, how == "segv"   ? "killed by SIGSEGV"
                                   : how == "hang" ? "did not return from load"
                                                   : "ended with exit code 0"));
    }
  }
}

TEST_CASE("what plugins do at the very end is done, and its result is that of the command") {
  const Commands commands;
  for (const std::string where : {"static", "atexit", "shared object", "thread"}) {
    const Outcome outcome = commands.run_one(commands.all[2], {{"HOSTILE_END", where + " print"}});
    INFO(where << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "ended\n"));
  }
}

TEST_CASE(
    "a plugin that crashes, hangs or calls exit at the very end is named, its results stand") {
  for (const std::string where : {"static", "atexit", "shared object", "thread"}) {
    for (const std::string how : {"segv", "hang", "exit", "_exit"}) {
      INFO(where << " " << how);
      const std::map<std::string, std::string> environment = {{"HOSTILE_END", where + " " + how}};
      const Strings options = {"--clock", "virtual", "--hang-limit", hang_limit(how), "--json"};
      const Outcome in_process = run_hostile({""}, Where::InProcess, options, environment);
      INFO(in_process.err);
      CHECK(in_process.code == 6);
      CHECK(contains(in_process.err, "hostile.so'"));
      CHECK(contains(in_process.err, "its destructors or exit handlers"));
      CHECK(parse_json(in_process.out)["result"] == "success");
      const Outcome isolated = run_hostile({""}, Where::Isolated, options, environment);
      INFO(isolated.err);
      CHECK(isolated.code == 0);
      CHECK(parse_json(isolated.out)["result"] == "success");
    }
  }
}

TEST_CASE("a stack overflow at the very end is reported, to the last destructor") {
  const Commands commands;
  for (const std::string where : {"static", "atexit", "shared object", "thread"}) {
    for (const Strings& arguments : {commands.all[0], commands.all[2]}) {
      INFO(arguments[0] << " " << where);
      const Outcome outcome = commands.run_one(arguments, {{"HOSTILE_END", where + " overflow"}});
      INFO(outcome.err);
      // What a thread keeps is there once a leaf was ticked, and only an init registers a handler.
      const bool has_it = arguments[0] == "run" || where == "static" || where == "shared object";
      CHECK(outcome.code == (has_it ? 6 : 0));
      if (!has_it) continue;
      CHECK(contains(outcome.err, "the plugin '" + commands.plugin + "'"));
      CHECK(contains(outcome.err, "the stack has overflowed"));
    }
  }
}

TEST_CASE("the end of a plugin's is named in every command") {
  const Commands commands;
  for (const std::string how : {"segv", "hang", "exit"}) {
    for (const Strings& arguments : commands.all) {
      INFO(arguments[0] << " " << how);
      const Outcome outcome = commands.run_one(arguments, {{"HOSTILE_END", "static " + how}});
      INFO(outcome.err);
      CHECK(outcome.code == 6);
      CHECK(contains(outcome.err, "the plugin '" + commands.plugin + "'"));
      CHECK_FALSE((outcome.out + outcome.err).empty());
    }
  }
}

TEST_CASE("a leaf that brings down a study is named, with its run") {
  const TemporaryDirectory directory;
  for (const std::string how : {"segv", "hang", "exit", "_exit", "throw hanging what"}) {
    INFO(how);
    const std::string tree = directory.file("tree.xml", hostile_tree({how}));
    const Strings arguments = {"study",
                               tree,
                               "--runs",
                               "40",
                               "--measure",
                               "duration",
                               "--jobs",
                               "2",
                               "--plugin-path",
                               LOCKSTEP_HOSTILE_DIRECTORY,
                               "--hang-limit",
                               "0.2",
                               "--no-plots",
                               "--out",
                               directory.path(how)};
    const Outcome outcome = run_lockstep(arguments);
    INFO(outcome.err);
    CHECK(outcome.code == 6);
    CHECK(contains(outcome.err, "the leaf 'Main/plan/arm' (Misbehave of plugin 'hostile')"));
    CHECK(contains(outcome.err, "tick 0"));
    CHECK(contains(outcome.err, "hint: this was run "));
  }
}

TEST_CASE("a plugin whose thread_local objects do not go keeps no study from ending") {
  const Commands commands;
  for (const std::string how : {"hang", "exit", "_exit", "segv"}) {
    const Outcome outcome =
        commands.run_one(commands.all.back(), {{"HOSTILE_END", "thread " + how}});
    INFO(outcome.err);
    CHECK(outcome.code == 6);
    CHECK(contains(outcome.err, "its destructors or exit handlers"));
  }
}

TEST_CASE("a child that a leaf forks off never comes back into the run") {
  const TemporaryDirectory directory;
  const auto recording = [&](const Misdeed& misdeed, Where where, Outcome& outcome) {
    const std::string file = directory.path("run.jsonl");
    outcome = run_hostile(misdeed, where,
                          {"--clock", "virtual", "--view", "plain", "--json", "--record", file});
    std::string text = read_file(file);
    return text.substr(text.find('\n'));  // without the header, which has the tree's path
  };
  for (const std::string function : {"create", "start", "tick", "halt", "progress", "destroy"}) {
    for (const std::string how : {"fork", "clone"}) {
      for (const Where where : {Where::InProcess, Where::Isolated}) {
        INFO(how << " in " << function << (where == Where::Isolated ? ", isolated" : ""));
        Outcome without, with;
        const std::string expected = recording({"", function}, where, without);
        const std::string recorded = recording({how, function}, where, with);
        INFO(with.err);
        CHECK(with.code == 0);
        CHECK(recorded == expected);
        CHECK(parse_json(with.out)["ticks"] == parse_json(without.out)["ticks"]);
        CHECK(with.err.find("run ends") == with.err.rfind("run ends"));
        // The end of the plugin's process may come before the child's words.
        if (where == Where::Isolated) continue;
        CHECK(contains(with.err, "the leaf 'Main/plan/"));
        CHECK(contains(with.err, "and the child came back from the call; the child was ended"));
      }
    }
  }
}

// From the second tick on, leaves that are next to each other are called in one loop.
TEST_CASE("a child that a leaf forks off among others in a later tick ends before the next leaf") {
  const TemporaryDirectory directory;
  for (const std::string function : {"tick", "progress"}) {
    for (const bool is_timed : {true, false}) {
      INFO(function << (is_timed ? ", timed" : ""));
      const std::string leaf =
          "<Misbehave name=\"{}\" how=\"{}\" where=\"{}\" at=\"3\" ticks=\"5\"/>";
      const std::string tree =
          directory.file("tree.xml",
                         "<root lockstep=\"1\"><plugin name=\"hostile\"/><BehaviorTree ID=\"Main\">"
                         "<ParallelAbsolute barriers=\"0.5\">" +
                             fmt::format(fmt::runtime(leaf), "first", "", function) +
                             fmt::format(fmt::runtime(leaf), "forks", "fork", function) +
                             fmt::format(fmt::runtime(leaf), "next", "print", function) +
                             "</ParallelAbsolute></BehaviorTree></root>");
      const Outcome outcome =
          run({.arguments = {"run", tree, "--plugin-path", LOCKSTEP_HOSTILE_DIRECTORY, "--rate",
                             "500", "--view", "none", "--tick-budget", is_timed ? "1000" : "0"}});
      INFO(outcome.err);
      CHECK(outcome.code == 0);
      CHECK(contains(outcome.err, "/forks'"));
      CHECK(contains(outcome.err, "and the child came back from the call; the child was ended"));
      const std::string printed = outcome.out + outcome.err;
      CHECK(contains(printed, "printed by a leaf"));
      CHECK(printed.find("printed by a leaf") == printed.rfind("printed by a leaf"));
    }
  }
}

TEST_CASE("a child that a leaf starts as system() does may end") {
  for (const Where where : {Where::InProcess, Where::Isolated}) {
    const Outcome outcome = run_hostile({"vfork"}, where, {"--clock", "virtual"});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_FALSE(contains(outcome.err, "called exit"));
  }
}

TEST_CASE("a child that a plugin forks off while it is loaded or initialized goes no further") {
  const Commands commands;
  for (const std::string variable : {"HOSTILE_LOAD", "HOSTILE_INIT"}) {
    const Outcome outcome = commands.run_one(commands.all[2], {{variable, "fork"}});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(lines(outcome.out).size() == lines(commands.run_one(commands.all[2], {}).out).size());
    CHECK(contains(outcome.err, "and the child came back from the call; the child was ended"));
  }
}

}  // namespace lockstep::host::test
