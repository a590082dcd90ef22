#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "support/paths.h"

using namespace lockstep::test;
using nlohmann::json;

namespace {

const std::string kEndless =
    "<Parallel><Advance name=\"arm\" step=\"0\"/><Sequence name=\"then\">"
    "<Advance name=\"base\" step=\"0\"/></Sequence></Parallel>";

}  // namespace

TEST_CASE("SIGINT and SIGTERM halt the running leaves in order and end the recording") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kEndless));
  const std::string file = directory.path("run.jsonl");
  for (const int number : {SIGINT, SIGTERM}) {
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
    const json end = json::parse(recording.back())["end"];
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
  std::string still;  // one signal does not: the leaf may yet come back
  for (int line = 0; line < 20; ++line) still += "stuck\n";
  REQUIRE(process.wait_for(still));
  process.signal(SIGINT);
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 130);
  CHECK(outcome.out.empty());
}

TEST_CASE("a signal restores the cursor of the terminal") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text(kEndless));
  Process process({.arguments = {"run", tree}}, Process::Output::Terminal);
  REQUIRE(process.wait_for("\x1b[?25l"));
  process.signal(SIGINT);
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 130);
  CHECK(outcome.out.rfind("\x1b[?25h") > outcome.out.rfind("\x1b[?25l"));
}
