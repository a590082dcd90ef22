// The manipulation scene of plugins/r1sim: the task's pace changes, and a profile can slow it down.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "unit/plugins/tree_run.h"

namespace lockstep::host::test {
namespace {

TEST_CASE("a task of even pace takes one over it, at any rate", "[plugins][r1sim]") {
  const TreeRunner runner("r1sim", "<DoTask min_speed=\"0.25\" max_speed=\"0.25\"/>");
  for (const double rate : {20.0, 100.0, 1000.0}) {
    CHECK(runner.run({.rate = rate}).seconds == Approx(4).margin(2 / rate));
  }
}

TEST_CASE("the pace of a task changes, and stays in its limits", "[plugins][r1sim]") {
  const TreeRunner runner("r1sim",
                          "<DoTask min_speed=\"0.1\" max_speed=\"0.4\" change_time=\"0.5\"/>");
  double before = 0;
  double last = 0;
  double slowest = 9;
  double fastest = 0;
  int changes = 0;
  const auto measure = [&](Ticker& ticker) {
    if (ticker.status(0) != Status::Running) return;
    const double speed = (ticker.progress(0) - before) / 0.01;
    before = ticker.progress(0);
    changes += std::abs(speed - last) > 1e-9;
    last = speed;
    slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  };
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    before = 0;
    changes = 0;
    CHECK(runner.run({.seed = seed, .after_tick = measure}).status == Status::Success);
    CHECK(changes > 5);
  }
  CHECK(slowest == Approx(0.1).margin(0.02));
  CHECK(slowest > 0.1 - 1e-9);
  CHECK(fastest == Approx(0.4).margin(0.02));
  CHECK(fastest < 0.4 + 1e-9);
}

TEST_CASE("a task takes as long at any rate, in the mean", "[plugins][r1sim]") {
  const TreeRunner runner("r1sim", "<DoTask change_time=\"0.1\"/>");
  const auto mean = [&](double rate) {
    double sum = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      sum += runner.run({.seed = seed, .rate = rate}).seconds;
    }
    return sum / 200;
  };
  CHECK(mean(1000) == Approx(mean(100)).margin(0.08));
}

TEST_CASE("a task that is held keeps what it has done", "[plugins][r1sim]") {
  const TreeRunner runner("r1sim",
                          "<ParallelRelative delta=\"0.1\"><DoTask name=\"task\" "
                          "min_speed=\"1\" max_speed=\"1\"/><DoTask name=\"slow\" "
                          "min_speed=\"0.1\" max_speed=\"0.1\"/></ParallelRelative>");
  const NodeIndex task = runner.node("task");
  double before = 0;
  int held = 0;
  const auto look = [&](Ticker& ticker) {
    if (ticker.status(task) != Status::Running) return;
    if (ticker.held(task)) CHECK(ticker.progress(task) == before);
    held += ticker.held(task);
    before = ticker.progress(task);
  };
  CHECK(runner.run({.after_tick = look}).status == Status::Success);
  CHECK(held > 500);
}

TEST_CASE("the seed decides the pace of a task", "[plugins][r1sim]") {
  const TreeRunner runner("r1sim", "<DoTask/>");
  CHECK(runner.run({.seed = 3}).seconds == runner.run({.seed = 3}).seconds);
  CHECK(runner.run({.seed = 3}).seconds != runner.run({.seed = 4}).seconds);
}

}  // namespace
}  // namespace lockstep::host::test
