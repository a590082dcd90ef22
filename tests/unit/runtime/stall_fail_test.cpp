#include "run/stall_fail.h"

#include <catch2/catch.hpp>

#include "support/scripted_run.h"

namespace lockstep::host {
namespace {

// Ticks at 10 Hz and writes down which node fails in which tick, and the status of the root at the
// end.
std::string stall_fail(std::string_view tree, std::string_view leaves, int ticks, double limit) {
  test::ScriptedRun run(tree, leaves);
  std::string text;
  int tick = 0;
  StallFail stall_fail(run.tree(), from_seconds(limit), [&](const Standstill&, NodeIndex failed) {
    text += std::string(run.tree().labels[failed].name) + "@" + std::to_string(tick) + ";";
  });
  Status status = Status::Running;
  for (; tick < ticks && status == Status::Running; ++tick) {
    const auto now = std::chrono::milliseconds(100) * tick;
    run.ticker().set_now(now);
    stall_fail.before_tick(run.ticker(), now);
    status = run.tick(now);
    stall_fail.after_tick(run.ticker(), now);
  }
  return text + std::string(to_string(status));
}

constexpr const char* kPair = "ParallelAbsolute[barriers=.5;1](a b)";

TEST_CASE("a synchronized node fails in the first tick in which it has stood for longer") {
  // b is held from tick 2 on.
  CHECK(stall_fail(kPair, "a=R.2R b+.25", 40, 0.35) == "ParallelAbsolute@6;failure");
  CHECK(stall_fail(kPair, "a=R.2R b+.25", 40, 0.4) == "ParallelAbsolute@7;failure");
  CHECK(stall_fail(kPair, "a=R.2R b+.25", 6, 0.35) == "running");
}

TEST_CASE("progress that was made in the last tick before counts") {
  // a moves in tick 5, so tick 6 finds a new best.
  CHECK(stall_fail(kPair, "a=R.2RRRRR.3R b+.25", 8, 0.35) == "running");
  CHECK(stall_fail(kPair, "a=R.2RRRRS b+.25", 8, 0.35) == "success");  // or it has succeeded
  CHECK(stall_fail(kPair, "a=R.2RRRRRR.3R b+.25", 8, 0.35) == "ParallelAbsolute@6;failure");
}

TEST_CASE("what is around the node reacts to its Failure") {
  CHECK(stall_fail("Fallback[memory=true](ParallelAbsolute[barriers=.5](a b) c)",
                   "a=R.2R b+.25 c=RS", 40, 0.35) == "ParallelAbsolute@6;success");
  // The second attempt begins in tick 7.
  CHECK(stall_fail("Retry[attempts=2](ParallelAbsolute[barriers=.5](a b))", "a=R.2R b+.25", 40,
                   0.35) == "ParallelAbsolute@6;ParallelAbsolute@13;failure");
}

TEST_CASE("members of pools that wait for each other fail when they have for longer") {
  // The synchronized node around them stands from tick 2 on, they from tick 5.
  CHECK(stall_fail("ParallelAbsolute[barriers=.5](Parallel(UseResources[pool=p resources=A "
                   "keep=true](Sequence[memory=true](a UseResources[pool=p resources=B "
                   "keep=true](x))) UseResources[pool=p resources=B keep=true]("
                   "Sequence[memory=true](b UseResources[pool=p resources=A keep=true](y)))) c)"
                   " resources[name=p]",
                   "a=RRRRRS b=RRRRRS x=R y=R c+.25", 40, 0.55) == "Parallel@11;failure");
}

TEST_CASE("a guard that fails for longer, and a leaf that fails again and again") {
  CHECK(stall_fail("ParallelAbsolute[barriers=.5 success_count=1 failure_count=2](g? b)",
                   "g=F b+.25", 40, 0.35) == "ParallelAbsolute@6;failure");
  CHECK(stall_fail("ParallelAbsolute[barriers=.5](Retry[attempts=99](a) b)", "a=R.1F... b+.25", 40,
                   0.35)
            .starts_with("ParallelAbsolute@"));
}

TEST_CASE("nobody fails where all come on") {
  CHECK(stall_fail(kPair, "a+.01 b+.25", 300, 0.35) == "success");
  CHECK(stall_fail("ParallelRelative[delta=0](a b)",
                   "a=R~0,1,0,0,0,1,0,0,0,1,0,0,0,1,0,0,0,1 b=R~0,1", 18, 0.35) == "running");
}

TEST_CASE("instead of a barrier, the lowest node above its members fails") {
  CHECK(stall_fail(
            "Fallback(Sequence(Parallel(SyncProgress[barrier=b](x) SyncProgress[barrier=b](y)))"
            " z) barrier[name=b barriers=.5]",
            "x+.25 y=R.1 z=S", 40, 0.35) == "Parallel@6;success");
}

TEST_CASE("a barrier around the children of a Parallel fails as a synchronized node does") {
  for (const double limit : {0.0, 0.15, 0.35, 1.0}) {
    for (const std::string leaves : {"x=R.2R y+.25", "x=R.2RRR.3R y+.25", "x=F y+.1"}) {
      const std::string expected =
          stall_fail("ParallelAbsolute[barriers=.5](x y)", leaves, 40, limit);
      const std::string got = stall_fail(
          "Parallel(SyncProgress[barrier=b](x) SyncProgress[barrier=b](y))"
          " barrier[name=b barriers=.5]",
          leaves, 40, limit);
      INFO(leaves << " " << limit);
      CHECK(got.substr(got.find('@') + 1) == expected.substr(expected.find('@') + 1));
    }
  }
}

constexpr const char* kCircle =
    "Fallback[memory=true](Parallel(SyncProgress[barrier=coarse](SyncProgress[barrier=fine](x))"
    " SyncProgress[barrier=coarse](Sequence[memory=true](a SyncProgress[barrier=fine](y)))) z)"
    " barrier[name=coarse barriers=.5] barrier[name=fine barriers=.25]";

TEST_CASE("of a circle, the lowest node that contains it fails, once its last node is due") {
  // fine stands since tick 5.
  CHECK(stall_fail(kCircle, "x+.05 a+.2 y+.001 z=S", 40, 0.55) == "Parallel@11;success");
}

TEST_CASE("a node that waits for another one leaves it to that") {
  // The outer node stands since tick 2, the inner one since tick 4.
  CHECK(stall_fail("ParallelAbsolute[barriers=.5](ForceSuccess(ParallelRelative[delta=.1](p q)) b)",
                   "p=R.2R q+.1 b+.25", 40, 0.55) == "ParallelRelative@10;success");
}

TEST_CASE("a node that waits for a slow one is not failed, as long as that one comes on") {
  constexpr const char* kSlow =
      "Parallel(ParallelAbsolute[barriers=.9](SyncProgress[barrier=b](x) a)"
      " SyncProgress[barrier=b](y)) barrier[name=b barriers=.3;.6]";
  CHECK(stall_fail(kSlow, "x+.1 a+.3 y+.01", 29, 0.55) == "running");
}

TEST_CASE("a node that is held itself has time until it gets ticks again") {
  CHECK(stall_fail("ParallelAbsolute[barriers=.2](o ParallelAbsolute[barriers=.5](a b))",
                   "o=RRRR.1RRRR.12RRRR.14RRRR.9R a=R.3 b=R.6", 17, 0.55) == "running");
}

}  // namespace
}  // namespace lockstep::host
