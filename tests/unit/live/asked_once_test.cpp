// However many watch a run, a leaf is asked for its progress once before a tick.
#include <catch2/catch.hpp>
#include <string>

#include "judge/measure/measure_spec.h"
#include "judge/measure/property_steps.h"
#include "judge/summary/property_observer.h"
#include "judge/summary/statistics.h"
#include "record/json_lines.h"
#include "record/live/line_feed.h"
#include "record/live/snapshot_feed.h"
#include "record/live/status_feed.h"
#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "study/run_measures.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::WatchedRun;

struct Counted {
  std::uint64_t alone = 0, watched = 0;
};

std::uint64_t asked(WatchedRun& run) {
  return run.run.leaf(0).asked();
}

// How often leaf a is asked in so many ticks: without observers, and with all of them.
Counted count(const std::string& tree, const std::string& leaves, std::uint64_t ticks) {
  Counted counted;
  WatchedRun alone(tree, leaves);
  alone.watch({}, ticks);
  counted.alone = asked(alone);

  WatchedRun run(tree, leaves);
  const Tree& compiled = run.run.tree();
  Recorder recorder(shape_of(compiled), {.path = "/dev/null", .run = {.tree_file = "test.xml"}});
  LineFeed lines(shape_of(compiled), {.tree_file = "test.xml"});
  StatusFeed statuses(shape_of(compiled));
  SnapshotFeed snapshots(shape_of(compiled));
  auto property = Property::parse("never a.progress > 0.9", property_names(shape_of(compiled)));
  REQUIRE(property);
  PropertyObserver properties({*property}, [](const Property&, std::string) {});
  Statistics statistics(shape_of(compiled));
  const auto spec = parse_measure("predictability:a@.5");
  REQUIRE(spec);
  RunMeasures measures(shape_of(compiled), {&*spec, 1}, 100);
  run.watch({&recorder, &lines, &statuses, &snapshots, &properties, &statistics, &measures}, ticks);
  counted.watched = asked(run);
  return counted;
}

std::string inverters(int depth) {
  std::string text = "a";
  for (int i = 0; i < depth; ++i) text = "Inverter(" + text + ")";
  return text;
}

}  // namespace

TEST_CASE("a leaf is asked for its progress once a tick, however deep it is and whoever watches") {
  for (const int depth : {0, 1, 10, 50}) {
    INFO(depth);
    const Counted counted = count(inverters(depth), "a=+.001", 100);
    CHECK(counted.alone == 0);
    CHECK(counted.watched == 99);  // it does not run before the first tick
  }
}

TEST_CASE("who watches adds one question to those of the synchronized nodes") {
  for (const char* tree : {"ParallelAbsolute[barriers=.5](a b)", "ParallelRelative[delta=.1](a b)",
                           "ParallelAbsolute[barriers=.5](Inverter(Parallel(a b)))",
                           "ParallelRelative[delta=1](ParallelAbsolute[barriers=.5](a b) d)"}) {
    INFO(tree);
    const Counted counted = count(tree, "a=+.001 b=+.001 d=+.001", 100);
    CHECK(counted.alone >= 99);
    CHECK(counted.watched == counted.alone + 99);
  }
}

TEST_CASE("progress that is shared is not that of the tick before") {
  WatchedRun run("Inverter(a)", "a=+.25");
  Ticker& ticker = run.run.ticker();
  for (const double expected : {0.0, .25, .5}) {
    ticker.share_progress();
    CHECK(ticker.progress(0) == expected);
    CHECK(ticker.progress(1) == expected);
    run.run.tick(Nanoseconds(0));
  }
}

TEST_CASE("progress that is shared ends with a run that is taken back or begun again") {
  test::ScriptedRun run("Inverter(a)", "a=+.25");
  Ticker& ticker = run.ticker();
  run.tick(Nanoseconds(0));
  const auto saved = run.save();
  run.tick(Nanoseconds(1));
  ticker.share_progress();
  CHECK(ticker.progress(0) == .5);
  run.restore(saved);
  CHECK(ticker.progress(0) == .25);
  ticker.share_progress();
  CHECK(ticker.progress(0) == .25);
  run.restart();
  CHECK(ticker.progress(0) == 0);
}

}  // namespace lockstep::host
