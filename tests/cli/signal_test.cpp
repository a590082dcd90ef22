#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

const std::string kEndless =
    "<Parallel><Advance name=\"arm\" step=\"0\"/><Sequence name=\"then\">"
    "<Advance name=\"base\" step=\"0\"/></Sequence></Parallel>";

// All that would end the process otherwise.
constexpr int kStopSignals[] = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT, SIGUSR1,
                                SIGUSR2, SIGALRM, SIGXCPU, SIGPROF, SIGPWR};

// Of the leaf that never comes back: it says so a hundred times a second. Longer than a signal that
// is sent twice at once counts as one.
std::string still_stuck() {
  std::string still;
  for (int line = 0; line < 50; ++line) still += "stuck\n";
  return still;
}

}  // namespace

TEST_CASE("a stop signal halts the running leaves in order and ends the recording") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kEndless));
  const std::string file = directory.path("run.jsonl");
  for (const int number : kStopSignals) {
    CAPTURE(number);
    Process process({.arguments = {"run", tree, "--rate", "100", "--record", file}});
    REQUIRE(process.wait_for("Main/Parallel/then/base: started"));
    process.signal(number);
    const Outcome outcome = process.finish();
    CHECK(outcome.code == 128 + number);
    CHECK(contains(outcome.out, "stopped: signal"));
    const auto first = outcome.err.find("Main/Parallel/arm: halted");
    const auto second = outcome.err.find("Main/Parallel/then/base: halted");
    CHECK(first != std::string::npos);
    CHECK(second != std::string::npos);
    CHECK(first < second);
    const auto recording = lines(read_file(file));
    const json end = parse_json(recording.back())["end"];
    CHECK(end["reason"] == "signal");
    CHECK(end["signal"] == number);
  }
}

TEST_CASE("a signal ends the sleep between slow ticks") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kEndless));
  Process process({.arguments = {"run", tree, "--rate", "0.001"}});  // a tick in 17 minutes
  REQUIRE(process.wait_for("Main/Parallel/then/base: started"));
  process.signal(SIGTERM);
  CHECK(process.finish().code == 143);
}

TEST_CASE("a second signal ends the program at once, whatever a leaf does") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Probe/></BehaviorTree></root>");
  Process process({.arguments = {"run", tree, "--view", "none", "--plugin",
                                 LOCKSTEP_BINARY_DIR "/tests/cli/stuck.so"}});
  REQUIRE(process.wait_for("stuck\n"));
  process.signal(SIGINT);
  process.clear_output();
  REQUIRE(process.wait_for(still_stuck()));  // one signal does not: the leaf may yet come back
  process.signal(SIGINT);
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 130);
  CHECK(outcome.out.empty());
}

TEST_CASE(
    "only a person is tired of waiting: other signals do not end a run that one has stopped") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Probe/></BehaviorTree></root>");
  for (const int number : {SIGHUP, SIGUSR1, SIGALRM, SIGXCPU}) {
    CAPTURE(number);
    Process process({.arguments = {"run", tree, "--view", "none", "--plugin",
                                   LOCKSTEP_BINARY_DIR "/tests/cli/stuck.so"}});
    REQUIRE(process.wait_for("stuck\n"));
    for (int time = 0; time < 3; ++time) {  // a terminal that closes, a timer
      process.signal(number);
      process.clear_output();
      REQUIRE(process.wait_for(still_stuck()));
    }
    process.signal(SIGTERM);
    CHECK(process.finish().code == 128 + SIGTERM);
  }
}

TEST_CASE("nohup is respected, and Ctrl-C counts where a shell has it ignored") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kEndless));
  Process process({.arguments = {"-c", "trap '' HUP INT; exec \"$0\" run \"$1\"",
                                 LOCKSTEP_BINARY_DIR "/lockstep", tree},
                   .program = "/bin/sh"});
  REQUIRE(process.wait_for("Main/Parallel/then/base: started"));
  process.signal(SIGHUP);
  process.signal(SIGINT);
  CHECK(process.finish().code == 130);
}

TEST_CASE("a file that may not grow is an error of the recording, not the end of the run") {
  const TemporaryDirectory directory;
  const std::string many = directory.file("many.xml", tree_text("<Advance step=\"0.000005\"/>"));
  const std::string few = directory.file("few.xml", tree_text("<Advance step=\"0.001\"/>"));
  const auto limited = [&](const std::string& tree, const std::string& policy) {
    return run({.arguments = {"-c", "ulimit -f 8; exec \"$@\"", "sh",
                              LOCKSTEP_BINARY_DIR "/lockstep", "run", tree, "--clock", "virtual",
                              "--record", directory.path("run.jsonl"), "--on-record-error", policy},
                .program = "/bin/bash"});
  };
  // More ticks than the queue to the disk takes, so that the run sees the error.
  const Outcome going_on = limited(many, "go-on"), stopped = limited(many, "stop");
  CHECK(limited(few, "go-on").code == 0);
  CHECK(limited(few, "stop").code == 8);  // which is known at its end only
  CHECK(going_on.code == 0);
  CHECK(contains(going_on.err, "File too large"));
  CHECK(stopped.code == 8);
  const Outcome info = run_lockstep({"log", "info", directory.path("run.jsonl")});
  CHECK(info.code == 0);
  CHECK(contains(info.err, "cut"));
}

TEST_CASE("recording and messages on one full disk: the policy counts, and the leaves are halted") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<Advance step=\"0.001\"/>"));
  for (const auto& [policy, code] : {std::pair("go-on", 0), {"stop", 8}}) {
    const Outcome outcome =
        run({.arguments = {"-c", "exec \"$@\" 2>/dev/full", "sh", LOCKSTEP_BINARY_DIR "/lockstep",
                           "run", tree, "--clock", "virtual", "--record", "/dev/full",
                           "--on-record-error", policy},
             .program = "/bin/sh"});
    CHECK(outcome.code == code);
    CHECK(contains(outcome.out, "note: cannot write '/dev/full': No space left on device"));
  }
}

TEST_CASE("a signal restores the cursor of the terminal") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kEndless));
  for (const int number : kStopSignals) {
    CAPTURE(number);
    Process process({.arguments = {"run", tree}}, Process::Output::Terminal);
    REQUIRE(process.wait_for("\x1b[?25l"));
    process.signal(number);
    const Outcome outcome = process.finish();
    CHECK(outcome.code == 128 + number);
    CHECK(outcome.out.rfind("\x1b[?25h") > outcome.out.rfind("\x1b[?25l"));
  }
}
