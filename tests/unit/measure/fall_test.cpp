#include "judge/measure/fall.h"

#include <catch2/catch.hpp>

#include "judge/measure/synchronized_ticks.h"
#include "run/live_moments.h"
#include "support/scripted_run.h"

namespace lockstep::host {
namespace {

std::string text(const std::optional<FallWatch::Fall>& fall) {
  if (!fall) return "-";
  return std::string(1, static_cast<char>('a' + fall->child)) + "@" +
         std::to_string(fall->time.count() / 100'000'000);
}

// Who fell first while ticked, who while held, and who rose first while held, and in which tick, at
// 10 Hz.
std::string falls(std::string_view tree, std::string_view leaves, NodeIndex node = 0) {
  test::ScriptedRun run(tree, leaves);
  LiveMoments moments(run.tree());
  SynchronizedTicks ticks(shape_of(run.tree()), node);
  FallWatch watch(run.tree().nodes[node].children);
  for (int tick = 0; tick < 12; ++tick) {
    const auto now = std::chrono::milliseconds(100) * tick;
    run.tick(now);
    watch.after_tick(ticks.read(moments.after_tick(run.ticker(), 0, now)));
  }
  return text(watch.while_ticked()) + " " + text(watch.while_held()) + " " +
         text(watch.rise_while_held());
}

TEST_CASE("progress that rises is no fall") {
  CHECK(falls("ParallelRelative[delta=.1](a b)", "a+.05 b+.2") == "- - -");
}

TEST_CASE("a fall while it is ticked is not one while it is held") {
  CHECK(falls("ParallelRelative[delta=1](a b)", "a+.1 b=R.4R.3R") == "b@2 - -");
  CHECK(falls("ParallelRelative[delta=0](a b)", "a=R.1 b=R~0,.5,.5,.3") == "- b@3 -");
  CHECK(falls("ParallelRelative[delta=0](a b)", "a=R~0,.1,.05 b=R~0,.5,.5,.3") == "a@2 b@3 -");
}

TEST_CASE("the beginning of another activation is no fall") {
  CHECK(falls("Repeat(ParallelRelative[delta=1](a b))", "a+.4 b+.5", 1) == "- - -");
  CHECK(falls("Sequence(c? ParallelRelative[delta=1](a b))", "c=SSSFSS a+.05 b+.1", 2) == "- - -");
}

TEST_CASE("a rise while it is held is noted, one while it is ticked is none") {
  CHECK(falls("ParallelRelative[delta=0](a b)", "a=R.1 b=R~0,.5,.5,.6") == "- - b@3");
  CHECK(falls("ParallelRelative[delta=1](a b)", "a=R.1 b=R~0,.5,.5,.6") == "- - -");
}

// As after lost ticks: the child may have had ticks in between.
TEST_CASE("a change across a joint is neither a fall nor a rise") {
  FallWatch watch(2);
  const auto see = [&](double a, double b) {
    const double progress[] = {a, b};
    const bool held[] = {false, true};
    watch.after_tick(
        {.ticked = true, .status = Status::Running, .progress = progress, .held = held});
  };
  const auto is_clean = [&] {
    return !watch.while_ticked() && !watch.while_held() && !watch.rise_while_held();
  };
  see(0, 0.2);
  watch.join();
  see(0.3, 0.5);
  watch.join();
  see(0.1, 0.2);
  CHECK(is_clean());
  see(0.2, 0.3);
  CHECK_FALSE(is_clean());
}

}  // namespace
}  // namespace lockstep::host
