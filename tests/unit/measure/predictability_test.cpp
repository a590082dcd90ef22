#include "judge/measure/predictability.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace lockstep::host {
namespace {

double nearest(double target, const std::vector<double>& progress) {
  NearestInstant instant(target);
  for (std::size_t i = 0; i < progress.size(); ++i) {
    instant.sample(static_cast<double>(i), progress[i]);
  }
  return instant.time();
}

TEST_CASE("the instant of nearest progress is the first of equals") {
  CHECK(nearest(0.5, {0, 0.2, 0.5, 0.5, 0.8}) == 2);
  CHECK(nearest(0.7, {0, 0.8, 0.6, 0.9}) == 1);  // in doubles, 0.6 is nearer by 1e-16
  CHECK(nearest(0.5, {0.6, 0.4}) == 0);
  CHECK(nearest(0.5, {0, 0.3, 0.9, 0.51, 0.2}) == 3);
  CHECK(nearest(1.0, {0, 0.3, 0.9}) == 2);
}

TEST_CASE("without samples there is no instant") {
  NearestInstant instant(0.5);
  CHECK(instant.empty());
  instant.sample(3, 0.75);
  CHECK_FALSE(instant.empty());
  CHECK(instant.gap() == 0.25);
}

TEST_CASE("a target is reached when the progress is at it, or on both sides") {
  struct Row {
    std::vector<double> progress;
    bool reached;
  };
  for (const Row& row : {Row{{0, 0.3}, false}, Row{{0.6, 0.9}, false}, Row{{0, 0.5}, true},
                         Row{{0, 0.9}, true}, Row{{0.9, 0.1}, true}, Row{{}, false}}) {
    NearestInstant instant(0.5);
    for (const double progress : row.progress) instant.sample(0, progress);
    CHECK(instant.reached() == row.reached);
  }
}

TEST_CASE("the predictability of a run, tick by tick") {
  Predictability it(0, 0.6, 2);
  struct NodeTick {
    bool ticked;
    Status status;
    double progress;
  };
  const auto after_tick = [&](std::uint64_t tick, const NodeTick& node) {
    const auto activity = static_cast<Activity>(node.status);
    const std::uint32_t reached = node.ticked ? 1 : 0;
    const Moment moment{.tick = tick,
                        .activity = {&activity, 1},
                        .reached = {&reached, 1},
                        .number = 1,
                        .progress = {&node.progress, 1}};
    it.after_tick({.moment = &moment});
  };
  const auto value = [&] { return it.value({}); };
  after_tick(0, {.ticked = false, .status = Status::Idle, .progress = 0});
  CHECK(std::isnan(it.gap()));  // a node that is not ticked is nowhere
  after_tick(1, {.ticked = true, .status = Status::Running, .progress = 0});
  CHECK(it.gap() == 0.6);
  after_tick(2, {.ticked = true, .status = Status::Running, .progress = 0.4});
  CHECK(std::isnan(value()));
  CHECK(it.gap() == Approx(0.2));
  after_tick(3, {.ticked = true, .status = Status::Running, .progress = 0.7});
  CHECK(value() == 1);
  it.reset();
  CHECK(std::isnan(it.gap()));
  after_tick(0, {.ticked = true, .status = Status::Success, .progress = 0});
  CHECK(value() == -1);  // in the tick after the last it is at 1
  CHECK(it.gap() == Approx(0.4));
  it.reset();
  after_tick(0, {.ticked = true, .status = Status::Failure, .progress = 0});
  CHECK(std::isnan(value()));
}

}  // namespace
}  // namespace lockstep::host
