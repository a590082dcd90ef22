// A reader of stderr who does not read: a paused pager, Ctrl-S, a stalled connection. From outside,
// with a pipe that is full from the start.
#include <signal.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "reliability/hostile_tree.h"
#include "support/json.h"

namespace lockstep::host::test {
namespace {

using nlohmann::json;

// lockstep with these arguments, its stderr in the dead end. Its 99 is its stdout.
Invocation unread(const DeadEnd& end, const std::vector<std::string>& arguments) {
  Invocation call{.arguments = {"-c", "exec \"$@\" 99>&1 2>&" + end.number(), "bash",
                                LOCKSTEP_BINARY_DIR "/lockstep"},
                  .program = "/bin/bash"};
  call.arguments.insert(call.arguments.end(), arguments.begin(), arguments.end());
  return call;
}

// Logs a line in each tick.
std::string loud_tree(const TemporaryDirectory& directory) {
  return directory.file("tree.xml", tree_text("<Repeat><Delay seconds=\"0.01\">"
                                              "<AlwaysSuccess/></Delay></Repeat>"));
}

}  // namespace

TEST_CASE("unread: time limits and signals end a run, its recording is closed") {
  const TemporaryDirectory directory;
  const DeadEnd stuck(DeadEnd::Reader::Stuck);
  const std::string tree = loud_tree(directory);
  for (const std::string view : {"plain", "live"}) {
    const std::string file = directory.path(view + ".jsonl");
    const Outcome outcome = run(unread(
        stuck, {"run", tree, "--timeout", "0.3", "--view", view, "--record", file, "--json"}));
    CHECK(outcome.code == 124);
    CHECK(parse_json(outcome.out)["ticks"] > 1);
    CHECK(contains(lines(read_file(file)).back(), "\"reason\":\"timeout\""));
  }
  Process process(unread(stuck, {"run", tree, "--view", "plain", "--record",
                                 directory.path("signal.jsonl"), "--json"}));
  while (!std::ifstream(directory.path("signal.jsonl"))) {  // it takes its name with the header
  }
  const Outcome outcome = process.end_by(SIGINT);
  CHECK(outcome.code == 130);
  CHECK(contains(parse_json(outcome.out)["notes"].dump(),
                 "of stderr are lost: no process read them"));
}

TEST_CASE("unread: a fault, a crash and a hang have their codes") {
  const DeadEnd stuck(DeadEnd::Reader::Stuck);
  for (const auto& [how, code] : std::vector<std::pair<std::string, int>>{
           {"throw exception", 5}, {"segv", 6}, {"abort", 6}, {"exit", 6}, {"hang", 6}}) {
    CAPTURE(how);
    const TemporaryDirectory directory;
    const std::string tree = directory.file("tree.xml", hostile_tree({how}));
    CHECK(run(unread(stuck, {"run", tree, "--plugin-path", LOCKSTEP_HOSTILE_DIRECTORY,
                             "--hang-limit", hang_limit(how)}))
              .code == code);
  }
}

TEST_CASE("unread: a second signal ends the program") {
  const DeadEnd stuck(DeadEnd::Reader::Stuck);
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Probe/></BehaviorTree></root>");
  Invocation call =
      unread(stuck, {"run", tree, "--plugin", LOCKSTEP_BINARY_DIR "/tests/cli/stuck.so",
                     "--hang-limit", "0", "--view", "live"});
  call.environment["STUCK_FILE"] = "99";  // its lines go to our stdout, not to the dead end
  Process process(call);
  REQUIRE(process.wait_for("stuck\n"));
  process.signal(SIGINT);
  const int code = process.end_by(SIGTERM).code;
  CHECK((code == 143 || code == 130));  // two threads take them, in any order
}

TEST_CASE("unread: a study makes its runs") {
  const DeadEnd stuck(DeadEnd::Reader::Stuck);
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<Advance step=\"0.1\"/>"));
  const Outcome outcome =
      run(unread(stuck, {"study", tree, "--runs", "500", "--measure", "duration", "--no-plots",
                         "--out", directory.path("s")}));
  CHECK(outcome.code == 0);
  CHECK(lines(read_file(directory.path("s/runs.csv"))).size() == 501);
}

}  // namespace lockstep::host::test
