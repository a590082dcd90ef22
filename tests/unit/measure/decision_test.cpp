#include "judge/measure/decision.h"

#include <catch2/catch.hpp>

#include "run/live_moments.h"
#include "support/scripted_run.h"

namespace lockstep::host {
namespace {

// Ticks until the root completes, at 10 Hz. "Fallback: failure 2/2 > b: failure"
std::string decided(std::string_view tree, std::string_view leaves) {
  test::ScriptedRun run(tree, leaves);
  for (int tick = 0; !is_complete(run.ticker().status(0)); ++tick) {
    REQUIRE(tick < 100);
    run.tick(std::chrono::milliseconds(100) * tick);
  }
  std::string text;
  LiveMoments moments(run.tree());
  const Moment& moment = moments.after_tick(run.ticker(), 0, {});
  for (const DecidingNode& node : deciding_path(shape_of(run.tree()), moment)) {
    if (!text.empty()) text += " > ";
    text += std::string(run.tree().labels[node.node].name) + ": ";
    text += to_string(node.status);
    if (node.agreeing > 1) {
      text += " " + std::to_string(node.agreeing) + "/" + std::to_string(node.children);
    }
  }
  return text;
}

TEST_CASE("what decided: the child at which a Sequence or a Fallback stopped") {
  CHECK(decided("Sequence(a b c)", "a=S b=RF c=S") == "Sequence: failure > b: failure");
  CHECK(decided("Sequence(a? b)", "a=SSF b=R") == "Sequence: failure > a: failure");
  CHECK(decided("Fallback(a b)", "a=F b=RF") == "Fallback: failure 2/2 > b: failure");
  CHECK(decided("Sequence[memory=true](a b)", "a=RS b=RF") == "Sequence: failure > b: failure");
  CHECK(decided("Fallback(a b c)", "a=F b=S c=S") == "Fallback: success > b: success");
  CHECK(decided("AlwaysFailure", "") == "AlwaysFailure: failure");
}

TEST_CASE("what decided: the child of a parallel that failed in the last tick") {
  CHECK(decided("Parallel[success_count=1 failure_count=2](a b c)", "a=RF b=F c=R") ==
        "Parallel: failure 2/3 > a: failure");
  CHECK(decided("ParallelAbsolute[barriers=.9](a Sequence(b c) d)", "a=R.1 b=S c=RF d=R.1") ==
        "ParallelAbsolute: failure > Sequence: failure > c: failure");
  // One failure is too many for both to succeed.
  CHECK(decided("Parallel[failure_count=2](a b)", "a=R b=RRF") == "Parallel: failure > b: failure");
}

TEST_CASE("what decided: decorators pass a result on, turn it around, or decide themselves") {
  CHECK(decided("Inverter(Fallback(a b))", "a=F b=S") ==
        "Inverter: failure > Fallback: success > b: success");
  CHECK(decided("Inverter(Sequence(a b))", "a=S b=S") ==
        "Inverter: failure > Sequence: success 2/2 > b: success");
  CHECK(decided("ForceFailure(a)", "a=RS") == "ForceFailure: failure > a: success");
  CHECK(decided("Retry[attempts=3](a)", "a=RF...") == "Retry: failure > a: failure");
  CHECK(decided("Repeat[times=5](a)", "a=SSRF") == "Repeat: failure > a: failure");
  CHECK(decided("Sequence(Timeout[seconds=.25](a) b)", "a=R b=S") ==
        "Sequence: failure > Timeout: failure");
  // It keeps its result and does not tick its child again.
  CHECK(decided("Retry[attempts=2](RunOnce(a))", "a=F") == "Retry: failure > RunOnce: failure");
}

}  // namespace
}  // namespace lockstep::host
