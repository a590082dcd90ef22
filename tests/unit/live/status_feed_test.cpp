// The statuses that Groot2 gets are those after each tick, also when nobody took the ones before.
#include "record/live/status_feed.h"

#include <catch2/catch.hpp>

#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::WatchedRun;

// Takes the changes after each so many ticks and after the next one, since a ring that was full has
// room from then on. Compares what it then knows with the run.
struct Taker final : Observer {
  Taker(const Tree& tree, std::uint64_t ticks)
      : feed(shape_of(tree)), every(ticks), known(tree.nodes.size()) {}
  AskedOfRun asked() const override { return feed.asked(); }
  void after_tick(const Moment& moment, const TickReport& report) override {
    feed.after_tick(moment, report);
    if (report.tick % every > 1) return;
    feed.take([&](NodeIndex node, Status status, Nanoseconds time) {
      if (time > report.time) FAIL("it is of a later tick");
      known[node] = status;
    });
    if (report.tick % every != 1 % every) return;
    for (NodeIndex node = 0; node < known.size(); ++node) {
      if (known[node] != moment.status(node)) FAIL("node " << node << ", tick " << report.tick);
    }
    ++looks;
  }
  StatusFeed feed;
  std::uint64_t every;
  std::vector<Status> known;
  int looks = 0;
};

// Nodes that change in each tick, so that the ring is full sooner or later.
constexpr const char* kChangingTree = "Repeat(ParallelAbsolute[barriers=.5](a b))";
constexpr const char* kChangingLeaves = "a=RRS... b+.3";

TEST_CASE("the statuses that were passed on are those of the run") {
  for (const std::uint64_t ticks : {1u, 7u, 50'000u}) {
    WatchedRun run(kChangingTree, kChangingLeaves);
    Taker taker(run.run.tree(), ticks);
    run.watch({&taker}, 100'002);
    CHECK(taker.looks >= static_cast<int>(100'000 / ticks));
  }
}

}  // namespace
}  // namespace lockstep::host
