#include "measure/predictability.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace lockstep {
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
  Predictability it(0.6, 2);
  const auto has_none = [&] { return std::isnan(it.value()); };
  it.after_tick(0, 0, false, Status::Idle);
  CHECK(std::isnan(it.gap()));  // a node that is not ticked is nowhere
  it.after_tick(1, 0, true, Status::Running);
  CHECK(it.gap() == 0.6);
  it.after_tick(2, 0.4, true, Status::Running);
  CHECK(has_none());
  CHECK(it.gap() == Approx(0.2));
  it.after_tick(3, 0.7, true, Status::Running);
  CHECK(it.value() == 1);
  it.reset();
  CHECK(std::isnan(it.gap()));
  it.after_tick(0, 0, true, Status::Success);
  CHECK(it.value() == -1);  // in the tick after the last it is at 1
  CHECK(it.gap() == Approx(0.4));
  it.reset();
  it.after_tick(0, 0, true, Status::Failure);
  CHECK(has_none());
}

TEST_CASE("predictability distance is negative for an early action") {
  const double times[] = {4.0, 5.0, 4.5};
  CHECK(predictability_distance(times, 5.0) == Approx(-0.5));
  CHECK(predictability_distance(times, 4.0) == Approx(0.5));
}

TEST_CASE("quartiles are the medians of the halves") {
  const SampleSummary odd = summarize({9, 1, 3, 7, 5});
  CHECK(odd.count == 5);
  CHECK(odd.min == 1);
  CHECK(odd.q1 == 2);  // of 1 3
  CHECK(odd.median == 5);
  CHECK(odd.q3 == 8);  // of 7 9
  CHECK(odd.max == 9);
  CHECK(odd.mean == Approx(5));

  const SampleSummary even = summarize({4, 1, 3, 2, 6, 5});
  CHECK(even.q1 == 2);
  CHECK(even.median == 3.5);
  CHECK(even.q3 == 5);
}

TEST_CASE("quartiles of few values") {
  const SampleSummary one = summarize({4});
  CHECK(one.q1 == 4);
  CHECK(one.q3 == 4);
  const SampleSummary two = summarize({4, 2});
  CHECK(two.q1 == 2);
  CHECK(two.median == 3);
  CHECK(two.q3 == 4);
  CHECK(summarize({}).count == 0);
}

}  // namespace
}  // namespace lockstep
