#include "judge/measure/stall.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "run/live_moments.h"
#include "support/scripted_run.h"

namespace lockstep::host {
namespace {

// Ticks at 10 Hz and writes down who was reported, at which tick and since when.
std::string watch(std::string_view tree, std::string_view leaves, int ticks, double limit) {
  test::ScriptedRun run(tree, leaves);
  std::string reports;
  int tick = 0;
  const Shape shape = shape_of(run.tree());
  LiveMoments moments(run.tree());
  StallWatch watch(shape, from_seconds(limit), [&](const Standstill& found) {
    const NodeIndex awaited =
        found.link().awaited + (run.tree().is_group(found.link().node) ? 1 : 0);
    reports += std::string(run.tree().labels[awaited].name) + "@" + std::to_string(tick) +
               " since " + std::to_string(found.since.count() / 100'000'000) + ";";
  });
  for (; tick < ticks; ++tick) {
    const auto now = std::chrono::milliseconds(100) * tick;
    run.tick(now);
    watch.after_tick(moments.after_tick(run.ticker(), static_cast<std::uint64_t>(tick), now));
  }
  return reports;
}

constexpr const char* kStallTree = "ParallelAbsolute[barriers=.5;1](a b)";

TEST_CASE("a child that stands still while another waits for it is reported once") {
  // b reaches the barrier with its second tick and is held from tick 2 on.
  CHECK(watch(kStallTree, "a=R.2R b+.25", 20, 0.35) == "a@6 since 2;");
}

TEST_CASE("exactly the limit is not longer than the limit") {
  CHECK(watch(kStallTree, "a=R.2R b+.25", 20, 0.4) == "a@7 since 2;");
}

TEST_CASE("a child that advances is no standstill") {
  CHECK(watch(kStallTree, "a+.01 b+.25", 40, 0.35) == "");
}

TEST_CASE("nobody stands in the way when nobody is held") {
  CHECK(watch("ParallelRelative[delta=1](a b)", "a=R b+.01", 40, 0.35) == "");
}

TEST_CASE("a standstill that becomes a circle is reported again") {
  // w has A first; then x owns it, held for y, which waits for A.
  const std::string reports = watch(
      "Parallel(UseResources[pool=p resources=A keep=true](w) ParallelAbsolute[barriers=.5]("
      "UseResources[pool=p resources=A keep=true](x) UseResources[pool=p resources=A keep=true](y) "
      "z))"
      " resources[name=p]",
      "w=RRRRRRRRRRRRRRRRRRRRS x+.1 y+.1 z+.1", 80, 0.4);
  CHECK(std::ranges::count(reports, ';') == 2);
}

TEST_CASE("a standstill that goes on after progress is a new one") {
  CHECK(watch(kStallTree, "a=R.2RRRRRRRRR.3R b+.25", 30, 0.35) == "a@6 since 2;a@14 since 10;");
}

TEST_CASE(
    "a child that starts again for ever is a standstill: its progress moves, its best does not") {
  // Without memory x is started again whenever y runs: 0.25, 0.6, 0.25, 0.6 …
  CHECK(watch("ParallelAbsolute[barriers=.8](Sequence(x y) b)", "x=R.5S... y=R.2 b=R.9", 30,
              0.55) == "Sequence@8 since 2;");
}

TEST_CASE("a child that loses while it is held what it gains is a standstill") {
  CHECK(watch("ParallelRelative[delta=0](a b)",
              "a=R~0,.3,0,.3,0,.3,0,.3,0,.3,0,.3,0,.3 b=R~0,.2,.4,.1,.3,0,.2,.1,.1,.1,.1,.1,.1,.1",
              14, 0.55) == "b@7 since 1;");
}

TEST_CASE("perpetual actions that are at 1 again and again are no standstill") {
  CHECK(watch("ParallelRelative[delta=0](a b)", "a=R~0,1,0,0,0,1,0,0,0,1,0,0,0,1,0,0,0,1 b=R~0,1",
              18, 0.35) == "");
  CHECK(watch("ParallelRelative[delta=0](a b)", "a=R~0,1,0,0,0,0,0,0,0,0,0 b=R~0,1", 18, 0.35) ==
        "a@6 since 2;");
}

TEST_CASE("a new activation has no best yet") {
  CHECK(watch("Repeat[times=9](ParallelAbsolute[barriers=.5](a b))",
              "a=R.1R.1R.6SR.1R.1R.6SR.1R.1R.6S b=R.6RSR.6RSR.6RS", 24, 0.35) == "");
}

TEST_CASE("who is held is not to blame") {
  CHECK(watch(kStallTree, "a=R.2R b+.25", 20, 0.35).find("b@") == std::string::npos);
}

TEST_CASE("time before anybody waited does not count") {
  CHECK(watch("ParallelRelative[delta=.5](a b)", "a=R b+.1", 20, 0.35) == "a@10 since 6;");
}

TEST_CASE("a circle is one standstill, as old as its youngest node") {
  // coarse holds its member from tick 7 on, fine from tick 10 on.
  constexpr const char* kCircle =
      "Parallel(SyncProgress[barrier=coarse](SyncProgress[barrier=fine](x))"
      " SyncProgress[barrier=coarse](Sequence[memory=true](a SyncProgress[barrier=fine](y))))"
      " barrier[name=coarse barriers=.5] barrier[name=fine barriers=.25]";
  CHECK(watch(kCircle, "x+.05 a+.2 y+.001", 40, 0.55) == "y@11 since 5;");
}

TEST_CASE("nodes that wait for the same one are one standstill") {
  constexpr const char* kChain =
      "Parallel(SyncProgress[barrier=one](SyncProgress[barrier=two](x)) "
      "SyncProgress[barrier=one](a)"
      " SyncProgress[barrier=two](b)) barrier[name=one barriers=.5] barrier[name=two barriers=.25]";
  CHECK(watch(kChain, "x+.05 a+.25 b=R.1", 40, 0.55) == "b@11 since 5;");
}

TEST_CASE("time in which a node is held itself does not count") {
  // b is held from tick 1 on, and the outer node holds the inner one in the ticks 4 to 13.
  CHECK(watch("ParallelAbsolute[barriers=.2](o ParallelAbsolute[barriers=.5](a b))",
              "o=R~.5,.5,.5,.5,0,0,0,0,0,0,0,0,0,0,.5 a=R.3R b=R.6", 40,
              0.55) == "o@10 since 4;a@17 since 11;");
}

TEST_CASE("who holds an inner node back and with it the outer one is reported once") {
  CHECK(watch("ParallelAbsolute[barriers=.5](Inverter(ParallelRelative[delta=.1](p q)) b)",
              "p=R.2R q+.1 b+.25", 40, 0.55) == "p@10 since 4;");
}

TEST_CASE("who waits for a slow one is reported, but later than one that waits for nothing") {
  // one waits for x, which two holds until y comes on; that is slow.
  CHECK(watch("Parallel(SyncProgress[barrier=one](SyncProgress[barrier=two](x))"
              " SyncProgress[barrier=one](a) SyncProgress[barrier=two](y))"
              " barrier[name=one barriers=.5] barrier[name=two barriers=.25]",
              "x+.25 a+.5 y+.01", 20, 0.55) == "SyncProgress@13 since 1;");
}

TEST_CASE("a member that holds a barrier's child and gives its resources away waits, too") {
  CHECK(watch("Parallel(UseResources[pool=p resources=A](SyncProgress[barrier=b](x))"
              " UseResources[pool=p resources=A](SyncProgress[barrier=b](y)))"
              " resources[name=p] barrier[name=b barriers=.5]",
              "x+.25 y=R.1", 40, 0.55) != "");
}

TEST_CASE("a long task of an owner that keeps is no standstill") {
  CHECK(watch("Parallel(UseResources[pool=p resources=A keep=true](x)"
              " UseResources[pool=p resources=A](y)) resources[name=p]",
              "x+.01 y+.25", 90, 0.55) == "");
}

TEST_CASE("members of pools alone that wait for each other are a standstill, reported once") {
  CHECK(watch("Parallel(UseResources[pool=p resources=A keep=true](Sequence[memory=true](a "
              "UseResources[pool=p resources=B keep=true](x)))"
              " UseResources[pool=p resources=B keep=true](Sequence[memory=true](b "
              "UseResources[pool=p resources=A keep=true](y)))) resources[name=p]",
              "a=RS b=RS x=R y=R", 40, 0.55) == "Sequence@7 since 1;");
}

TEST_CASE("a synchronized node that waits for such members leaves the report to them") {
  CHECK(watch("ParallelAbsolute[barriers=.5](Parallel(UseResources[pool=p resources=A keep=true]("
              "Sequence[memory=true](a UseResources[pool=p resources=B keep=true](x)))"
              " UseResources[pool=p resources=B keep=true](Sequence[memory=true](b "
              "UseResources[pool=p resources=A keep=true](y)))) c) resources[name=p]",
              "a=RS b=RS x=R y=R c+.25", 40, 0.55) == "Sequence@7 since 1;");
}

}  // namespace
}  // namespace lockstep::host
