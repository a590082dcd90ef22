// A run on a terminal waits after its end for those who have its page open: they may load it again.
#include <catch2/catch.hpp>
#include <csignal>

#include "web/client.h"

namespace lockstep::host::test {
namespace {

constexpr auto kWaits = "no browser has it open";

std::string failing_tree() {
  return "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Sequence memory=\"true\">"
         "<Wait seconds=\"1\"/><AlwaysFailure/></Sequence></BehaviorTree></root>";
}

struct TerminalRun {
  TerminalRun()
      : process({.arguments = {"run", directory.file("tree.xml", failing_tree()), "--monitor",
                               "--view", "plain"}},
                Process::Output::Terminal) {
    const std::string before = "monitor: http://127.0.0.1:";
    REQUIRE(process.wait_for(before));
    REQUIRE(process.wait_for("starts"));
    const std::string& text = process.so_far().out;
    port = static_cast<unsigned>(std::stoul(text.substr(text.find(before) + before.size())));
  }

  TemporaryDirectory directory;
  Process process;
  unsigned port = 0;
};

}  // namespace

TEST_CASE("a run on a terminal waits for a browser that has its page open, until that leaves") {
  TerminalRun run;
  {
    Client reader(run.port);
    reader.send(get_text(run.port, "/events"));
    REQUIRE(run.process.wait_for(kWaits));
    CHECK(get(run.port, "/").status == 200);
    const Response again = get(run.port, "/history");
    CHECK(contains(again.body, "\"AlwaysFailure\""));
    CHECK(contains(again.body, "\"failure\""));
  }
  CHECK(run.process.finish().code == 1);
}

TEST_CASE("a signal ends the waiting for a browser, not with another exit code") {
  TerminalRun run;
  Client reader(run.port);
  reader.send(get_text(run.port, "/events"));
  REQUIRE(run.process.wait_for(kWaits));
  CHECK(run.process.end_by(SIGINT).code == 1);
}

TEST_CASE("a run on a terminal waits for nobody when no browser is there") {
  TerminalRun run;
  const Outcome outcome = run.process.finish();
  CHECK(outcome.code == 1);
  CHECK_FALSE(contains(outcome.out, kWaits));
}

}  // namespace lockstep::host::test
