// What a leaf can do to the process it lives in, beyond ending it: stdout, memory, signals, modes,
// threads; and what is left of a run that was killed.
#include <signal.h>

#include <catch2/catch.hpp>

#include "reliability/hostile_tree.h"
#include "support/json.h"

namespace lockstep::host::test {
namespace {

using nlohmann::json;
using Strings = std::vector<std::string>;

constexpr Where kBoth[] = {Where::InProcess, Where::Isolated};

// A tree that runs until it is stopped, after the leaf has done its misdeed.
std::string endless_tree(const Misdeed& misdeed) {
  return "<root lockstep=\"1\"><plugin name=\"hostile\"/><BehaviorTree ID=\"Main\">"
         "<Misbehave name=\"arm\" how=\"" +
         misdeed.how + "\" where=\"" + misdeed.where +
         "\" ticks=\"1000000000\"/></BehaviorTree></root>";
}

}  // namespace

TEST_CASE("what a leaf prints does not mix with the results") {
  for (const Where where : kBoth) {
    const Outcome outcome = run_hostile({"print"}, where, {"--clock", "virtual", "--json"});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(parse_json(outcome.out)["result"] == "success");
    CHECK(contains(outcome.err, "printed by a leaf"));
    CHECK(contains(outcome.err, "written by a leaf"));
  }
}

TEST_CASE("a leaf that leaks is reported by the memory it takes, and whose it is when isolated") {
  // The leak is meant: a sanitizer need not tell.
  const std::map<std::string, std::string> environment = {
      {"ASAN_OPTIONS", "intercept_tls_get_addr=0:detect_leaks=0"}};
  const Outcome in_process =
      run_hostile({"leak"}, Where::InProcess, {"--clock", "virtual"}, environment);
  CHECK(in_process.code == 0);
  CHECK(contains(in_process.out, "memory grew by "));
  const Outcome isolated = run_hostile({"leak"}, Where::Isolated, {"--clock", "virtual"});
  CHECK(isolated.code == 0);
  CHECK_FALSE(contains(isolated.out, "memory grew by"));  // it went with the plugin's process
}

TEST_CASE("what a large tree and its recording take is not called a leak") {
  const TemporaryDirectory directory;
  std::string leaves;
  for (int i = 0; i < 100'000; ++i) leaves += "<Wait seconds=\"0\"/>\n";
  const std::string tree =
      directory.file("tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Parallel>" +
                                     leaves + "</Parallel></BehaviorTree></root>");
  const Outcome outcome = run_lockstep({"run", tree, "--clock", "virtual", "--view", "none",
                                        "--record", directory.path("run.jsonl")});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK_FALSE(contains(outcome.out, "memory grew by"));
}

TEST_CASE("a leaf that blocks all signals cannot keep a run from being stopped") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", endless_tree({"block signals"}));
  for (const Where where : kBoth) {
    Strings arguments = {"run",    tree,   "--plugin-path", LOCKSTEP_HOSTILE_DIRECTORY,
                         "--view", "plain"};
    if (where == Where::Isolated) arguments.emplace_back("--isolate");
    Process process({.arguments = arguments});
    REQUIRE(process.wait_for("Main/arm: started"));
    process.signal(SIGINT);
    const Outcome outcome = process.finish();
    CHECK(outcome.code == 130);
    CHECK(contains(outcome.err, "Main/arm: halted"));
    CHECK(contains(outcome.out, "changed the signal mask") == (where == Where::InProcess));
  }
}

TEST_CASE("a rounding mode that a leaf changes is set back, and it is named") {
  const Outcome in_process = run_hostile({"round up"}, Where::InProcess, {"--clock", "virtual"});
  CHECK(in_process.code == 0);
  CHECK(contains(in_process.err,
                 "arm' (Misbehave of plugin 'hostile') changed the floating-point mode in tick"));
  const Outcome isolated = run_hostile({"round up"}, Where::Isolated, {"--clock", "virtual"});
  CHECK(isolated.code == 0);
  CHECK_FALSE(contains(isolated.err, "floating-point"));
}

TEST_CASE(
    "an exception that a leaf makes trap after it has happened is set back, and it is named") {
  for (const std::string function : {"create", "start", "tick"}) {
    const Outcome outcome =
        run_hostile({"trap", function}, Where::InProcess, {"--clock", "virtual"});
    INFO(function << '\n' << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, function == "create"
                                    ? "its create has changed the rounding mode or the "
                                    : "arm' (Misbehave of plugin 'hostile') changed the "));
  }
}

TEST_CASE("an exception that loading a plugin makes trap after it has happened is set back") {
  for (const Where where : kBoth) {
    const Outcome outcome =
        run_hostile({""}, where, {"--clock", "virtual"}, {{"HOSTILE_LOAD", "trap"}});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("a rounding mode that loading a plugin changes is set back") {
  for (const Where where : kBoth) {
    const Outcome outcome = run_hostile({"tell rounding"}, where, {"--clock", "virtual"},
                                        {{"HOSTILE_LOAD", "round up"}});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "rounds to nearest"));
  }
}

TEST_CASE("a plugin that crashes while it is loaded is named, or refused") {
  const std::map<std::string, std::string> environment = {{"HOSTILE_LOAD", "segv"}};
  const Outcome in_process = run_hostile({""}, Where::InProcess, {}, environment);
  CHECK(in_process.code == 6);
  CHECK(contains(in_process.err, "hostile.so"));
  const Outcome isolated = run_hostile({""}, Where::Isolated, {}, environment);
  CHECK(isolated.code == 4);
  CHECK(contains(isolated.err, "killed by SIGSEGV"));
}

TEST_CASE("what cannot be caught in this process is a fault in another") {
  CHECK(run_hostile({"kill"}, Where::InProcess, {"--clock", "virtual"}).code == 128 + SIGKILL);
  const Outcome outcome = run_hostile({"kill"}, Where::Isolated, {"--clock", "virtual"});
  CHECK(outcome.code == 5);
  CHECK(contains(outcome.err, "killed by SIGKILL"));
}

TEST_CASE("a thread that a leaf leaves behind does not outlive the program") {
  for (const Where where : kBoth) {
    CHECK(run_hostile({"leave a thread"}, where, {"--clock", "virtual"}).code == 0);
  }
}

TEST_CASE("a thread of an isolated plugin that logs without end keeps nobody") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", endless_tree({"log in a thread"}));
  // How many lines were taken, shown or not. On the virtual clock 3000 ticks may be over before the
  // thread has begun.
  const auto lines_taken = [&](const std::string& clock, int ticks) {
    const Outcome outcome = run_lockstep({"run", tree, "--plugin-path", LOCKSTEP_HOSTILE_DIRECTORY,
                                          "--isolate", "--clock", clock, "--rate", "3000",
                                          "--max-ticks", std::to_string(ticks), "--json"});
    CHECK(outcome.code == 124);
    CHECK(parse_json(outcome.out)["ticks"] == ticks);
    CHECK(contains(outcome.err, "still here"));
    CHECK(contains(outcome.err, " lines of leaves left out"));
    std::size_t taken = 0;
    for (const std::string& line : lines(outcome.err)) {
      const std::size_t note = line.find("... ");
      taken += note == std::string::npos ? 1 : std::stoul(line.substr(note + 4));
    }
    return taken;
  };
  // A ring of 256 KiB is full of 6000 lines; in the end all that is in the two rings is taken. Were
  // the ticks to wait for lines, there would be as many in every tick.
  CHECK(lines_taken("virtual", 30'000) < 20'000);
  // In the second that passes, a hundred each 0.1 s, and not a ring.
  CHECK(lines_taken("wall", 3000) < 20'000);
}

TEST_CASE("a crash in a thread of a plugin is reported as such") {
  const Outcome in_process =
      run_hostile({"segv in a thread"}, Where::InProcess, {"--clock", "virtual"});
  CHECK(in_process.code == 6);
  CHECK(contains(in_process.err, "thread"));
  CHECK(run_hostile({"segv in a thread"}, Where::Isolated, {"--clock", "virtual"}).code == 5);
}

TEST_CASE("the host refuses a thread that is not the run's, but for log") {
  for (const Where where : kBoth) {
    const Outcome outcome =
        run_hostile({"foreign call"}, where, {"--clock", "virtual", "--view", "plain"});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "a foreign thread was refused"));
    CHECK_FALSE(contains(outcome.err, "a foreign thread was served"));
  }
}

TEST_CASE("an isolated plugin leaves no process behind, however its run ends") {
  const OwnPlugin plugin;
  for (const std::string how : {"", "segv", "hang", "leave a thread", "kill"}) {
    INFO(how);
    const Outcome outcome = run_hostile({how}, Where::Isolated,
                                        {"--clock", "virtual", "--hang-limit", hang_limit(how),
                                         "--plugin", plugin.directory() + "hostile.so"});
    CHECK(outcome.code == (how.empty() || how == "leave a thread" ? 0 : 5));
    CHECK_FALSE(plugin.has_processes());
  }
}

TEST_CASE("killed with SIGKILL, a run leaves no process and a recording that can be read") {
  const OwnPlugin plugin;
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", endless_tree({""}));
  const std::string file = directory.path("run.jsonl");
  Process process({.arguments = {"run", tree, "--plugin-path", plugin.directory(), "--isolate",
                                 "--view", "plain", "--record", file}});
  REQUIRE(process.wait_for("Main/arm: started"));
  while (lines(read_file(file)).size() < 3) {  // the first flush of ticks
  }
  process.signal(SIGKILL);
  CHECK(process.finish().code == 128 + SIGKILL);
  while (plugin.has_processes()) {
  }
  const Outcome info = run_lockstep({"log", "info", file});
  CHECK(info.code == 0);
  CHECK(contains(info.err, "cut"));
}

TEST_CASE("after a crash in this process, the recording is whole up to the last completed tick") {
  for (const std::string how : {"segv", "exit", "abort", "overflow", "hang"}) {
    INFO(how);
    const TemporaryDirectory directory;
    const std::string file = directory.path("run.jsonl");
    const std::string tree =
        directory.file("tree.xml",
                       "<root lockstep=\"1\"><plugin name=\"hostile\"/><BehaviorTree "
                       "ID=\"Main\"><Misbehave at=\"8\" "
                       "how=\"" +
                           how + "\" ticks=\"100\"/></BehaviorTree></root>");
    const Outcome outcome =
        run_lockstep({"run", tree, "--plugin-path", LOCKSTEP_HOSTILE_DIRECTORY, "--record", file,
                      "--clock", "virtual", "--hang-limit", hang_limit(how)});
    INFO(outcome.err);
    CHECK(outcome.code == 6);
    CHECK(contains(outcome.err, "tick 7"));
    const auto recording = lines(read_file(file));
    REQUIRE(recording.size() == 8);  // the header and the ticks 0 to 6
    CHECK(parse_json(recording.back())["tick"] == 6);
  }
}

}  // namespace lockstep::host::test
