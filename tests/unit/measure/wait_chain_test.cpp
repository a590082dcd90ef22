#include "judge/measure/wait_chain.h"

#include <catch2/catch.hpp>

#include "run/live_moments.h"
#include "support/scripted_run.h"

namespace lockstep::host {
namespace {

// "r: b waits for a; pool: c waits for b; circle". A member is called by its child.
std::string chain(std::string_view tree_text, std::string_view leaves, std::string_view from,
                  int ticks = 40) {
  test::ScriptedRun run(tree_text, leaves);
  for (int tick = 0; tick < ticks; ++tick) run.tick(tick * std::chrono::milliseconds(100));
  const Tree& tree = run.tree();
  const auto label = [&](NodeIndex node) { return std::string(tree.labels[node].name); };
  const auto name = [&](const WaitLink& link, NodeIndex node) {
    return label(tree.is_group(link.node) ? node + 1 : node);
  };
  NodeIndex node = 0;
  while (label(node) != from) ++node;
  const Shape shape = shape_of(tree);
  LiveMoments moments(tree);
  const Moment& moment = moments.now(run.ticker());
  if (!holds_somebody(shape, moment, node)) return "nobody is held";
  const WaitChain found = wait_chain(shape, moment, node);
  std::string text;
  for (const WaitLink& link : found.links) {
    text += label(link.node) + ": " + name(link, link.waiting) + " waits for " +
            name(link, link.awaited) + "; ";
  }
  constexpr const char* kObstacles[] = {"idle", "failed", "running", "denied", "circle"};
  return text + kObstacles[static_cast<std::size_t>(found.obstacle)];
}

constexpr const char* kNested =
    "Parallel(SyncProgress[barrier=coarse](SyncProgress[barrier=fine](x))"
    " SyncProgress[barrier=coarse](Sequence[memory=true](a SyncProgress[barrier=fine](y))))"
    " barrier[name=coarse barriers=.5] barrier[name=fine barriers=.25]";

TEST_CASE("a circle of barriers, of which one is inside of what the other holds") {
  const std::string circle = "coarse: Sequence waits for SyncProgress; fine: x waits for y; circle";
  CHECK(chain(kNested, "x+.05 a+.1 y+.05", "coarse") == circle);
  CHECK(chain(kNested, "x+.05 a+.1 y+.05", "fine") == circle);  // from wherever it is looked at
}

TEST_CASE("a circle of a synchronized node and barriers, one behind the other in a sequence") {
  CHECK(chain("Parallel("
              "ParallelRelative[delta=.1](SyncProgress[barrier=g](x)"
              " Sequence[memory=true](a SyncProgress[barrier=h](b)))"
              " Sequence[memory=true](SyncProgress[barrier=h](d) SyncProgress[barrier=g](y)))"
              " barrier[name=g barriers=.5] barrier[name=h barriers=.5]",
              "x+.05 a+.1 b+.05 d+.05 y+.05", "g") ==
        "ParallelRelative: Sequence waits for SyncProgress; g: x waits for y; h: d waits for b; "
        "circle");
}

TEST_CASE("a circle through a pool whose owner keeps") {
  CHECK(chain("ParallelRelative[delta=.2](UseResources[pool=p resources=A keep=true](x)"
              " UseResources[pool=p resources=A](y)) resources[name=p]",
              "x+.05 y+.05", "ParallelRelative") ==
        "ParallelRelative: UseResources waits for UseResources; p: y waits for x; circle");
  CHECK(chain("Parallel(UseResources[pool=p resources=A keep=true](SyncProgress[barrier=b](x))"
              " UseResources[pool=p resources=A](SyncProgress[barrier=b](y)))"
              " resources[name=p] barrier[name=b barriers=.5]",
              "x+.05 y+.05",
              "b") == "p: SyncProgress waits for SyncProgress; b: x waits for y; circle");
}

TEST_CASE("without keep, the first in the tree owns for ever where priorities do not rise") {
  constexpr std::string_view kChain =
      "Parallel(UseResources[pool=p resources=A](Parallel(SyncProgress[barrier=b](x) w))"
      " UseResources[pool=p resources=A](SyncProgress[barrier=b](y)))"
      " barrier[name=b barriers=.5] resources[name=p increment=";
  CHECK(chain(std::string(kChain) + "0]", "x+.05 w+.1 y+.05", "b") ==
        "b: x waits for y; p: SyncProgress waits for Parallel; circle");
  CHECK(chain(std::string(kChain) + "1]", "x+.05 w+.1 y=R.1", "b") == "b: x waits for y; running");
}

TEST_CASE("a chain leads over several nodes to what is to blame") {
  const std::string_view leaves = "x+.05 a+.2 b+.05 c=R.1";
  constexpr const char* kChain =
      "Parallel(SyncProgress[barrier=one](SyncProgress[barrier=two](x)) "
      "SyncProgress[barrier=one](a)"
      " ParallelAbsolute[barriers=.2](SyncProgress[barrier=two](b) c))"
      " barrier[name=one barriers=.5] barrier[name=two barriers=.25]";
  CHECK(chain(kChain, leaves, "one") ==
        "one: a waits for SyncProgress; two: x waits for b; ParallelAbsolute: SyncProgress waits "
        "for c; running");
}

TEST_CASE("what is to blame does not run, has failed, or lacks what another one uses") {
  constexpr const char* kTwo = "barrier[name=b barriers=.5]";
  const auto at_barrier = [&](const std::string& other, std::string_view leaves) {
    return chain("Parallel[failure_count=2](SyncProgress[barrier=b](x) " + other + ") " + kTwo,
                 leaves, "b");
  };
  CHECK(at_barrier("Fallback[memory=true](a SyncProgress[barrier=b](y))", "x+.1 a=S y=R") ==
        "b: x waits for y; idle");
  CHECK(at_barrier("Sequence[memory=true](a SyncProgress[barrier=b](y))", "x+.1 a=R y=R") ==
        "b: x waits for y; idle");
  CHECK(at_barrier("KeepRunningUntilFailure(Inverter(ForceFailure(SyncProgress[barrier=b](y))))",
                   "x+.1 y=F") == "b: x waits for y; failed");
  CHECK(chain("ParallelAbsolute[barriers=.5 success_count=1 failure_count=2](g? x)", "g=F x+.1",
              "ParallelAbsolute") == "ParallelAbsolute: x waits for g; failed");
  CHECK(
      chain("Parallel(UseResources[pool=p resources=A keep=true](owner)"
            " ParallelRelative[delta=.2](x UseResources[pool=p resources=A](y))) resources[name=p]",
            "owner=R x+.1 y+.1", "ParallelRelative") ==
      "ParallelRelative: x waits for UseResources; p: y waits for owner; denied");
}

TEST_CASE("of a parallel that waits, the child counts that it lacks") {
  // The second child is at .1 because of w, not because of y, which is held.
  CHECK(chain("Parallel(ParallelAbsolute[barriers=.5](x Parallel(w SyncProgress[barrier=b](y)))"
              " SyncProgress[barrier=b](z)) barrier[name=b barriers=.3]",
              "x+.1 w=R.1 y+.1 z=R.2",
              "ParallelAbsolute") == "ParallelAbsolute: x waits for Parallel; running");
  CHECK(chain("Parallel(ParallelAbsolute[barriers=.5](x Parallel(w SyncProgress[barrier=b](y)))"
              " SyncProgress[barrier=b](z)) barrier[name=b barriers=.3]",
              "x+.1 w=R.9 y+.1 z=R.2", "ParallelAbsolute") ==
        "ParallelAbsolute: x waits for Parallel; b: y waits for z; running");
}

TEST_CASE("a member that holds a barrier's child gives its resources to others meanwhile") {
  CHECK(chain("Parallel(UseResources[pool=p resources=A](SyncProgress[barrier=b](x))"
              " UseResources[pool=p resources=A](SyncProgress[barrier=b](y)))"
              " resources[name=p] barrier[name=b barriers=.5]",
              "x+.1 y=R.1", "b") == "b: x waits for y; running");
}

TEST_CASE("what a node waits for may keep another node in it waiting, or a barrier") {
  CHECK(chain("ParallelAbsolute[barriers=.5](Inverter(ParallelRelative[delta=.1](p q)) b)",
              "p=R.2R q+.1 b+.25", "ParallelAbsolute") ==
        "ParallelAbsolute: b waits for Inverter; ParallelRelative: q waits for p; running");
  CHECK(chain("Parallel(SyncProgress[barrier=b](x)"
              " ParallelAbsolute[barriers=.5](SyncProgress[barrier=b](p) q)) barrier[name=b "
              "barriers=.9]",
              "x+.1 p=R.1 q+.1", "ParallelAbsolute") ==
        "ParallelAbsolute: q waits for SyncProgress; b: x waits for p; running");
}

TEST_CASE("who is not held waits for nobody") {
  CHECK(chain("ParallelAbsolute[barriers=.5](x y)", "x=R.2 y=R.1", "ParallelAbsolute") ==
        "nobody is held");
}

}  // namespace
}  // namespace lockstep::host
