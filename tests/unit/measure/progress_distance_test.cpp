#include "judge/measure/progress_distance.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>

#include "base/core/random.h"
#include "judge/measure/spread.h"
#include "judge/measure/step_length.h"

namespace lockstep::host {
namespace {

double distance(std::vector<double> progress) {
  return PairDistance(progress.size()).of(progress);
}

TEST_CASE("progress distance counts each unordered pair once") {
  CHECK(distance({}) == 0);
  CHECK(distance({0.7}) == 0);
  CHECK(distance({0.2, 0.5}) == Approx(0.3));
  CHECK(distance({0.5, 0.2}) == Approx(0.3));
  CHECK(distance({0.1, 0.2, 0.5}) == Approx(0.1 + 0.4 + 0.3));
  CHECK(distance({1, 0, 1, 0}) == Approx(4));
  CHECK(distance({0.4, 0.4, 0.4}) == 0);
}

TEST_CASE("progress distance is the same for few children and for many, in any order") {
  RandomStream random(7, 0);
  for (std::size_t children = 2; children <= 40; ++children) {
    INFO(children << " children");
    std::vector<double> progress(children);
    for (double& it : progress) it = std::round(random.next_double() * 20) / 20;  // some are equal
    double pairs = 0;
    for (const double one : progress) {
      for (const double other : progress) pairs += std::abs(one - other) / 2;
    }
    CHECK(distance(progress) == Approx(pairs));
    std::vector<double> sorted = progress;
    std::sort(sorted.begin(), sorted.end());
    CHECK(distance(progress) == distance(sorted));
    CHECK(distance({sorted.rbegin(), sorted.rend()}) == distance(sorted));
  }
}

TEST_CASE("progress distance is the same to the last bit, whatever the order was before") {
  RandomStream random(8, 0);
  for (const std::size_t children : {2, 16, 17, 100}) {
    PairDistance kept(children);
    std::vector<double> progress(children, 0);
    for (int tick = 0; tick < 200; ++tick) {
      INFO(children << " children, tick " << tick);
      const double step = tick % 50 == 0 ? 1 : 0.01;  // now and then all change places
      for (double& it : progress) it = tick % 70 == 0 ? 0.5 : it + step * random.next_double();
      if (tick % 9 == 0) progress[tick % children] = kLeftOut;
      std::vector<double> sorted;
      std::ranges::copy_if(progress, std::back_inserter(sorted),
                           [](double it) { return !is_left_out(it); });
      std::ranges::sort(sorted);
      double sum = 0;
      for (std::size_t i = 1; i < sorted.size(); ++i) {
        sum += (sorted[i] - sorted[i - 1]) * static_cast<double>(i * (sorted.size() - i));
      }
      CHECK(kept.of(progress) == sum);
      if (tick % 9 == 0) progress[tick % children] = 0.25;
    }
  }
}

// The progress before each tick of the worked traces, derived by hand from who is ticked.
struct Trace {
  const char* name;
  std::vector<std::vector<double>> samples;
  double sum, largest_spread, step;
};

const Trace kTraces[] = {
    {"A1",
     {{0, 0},
      {.1, .3},
      {.2, .6},
      {.3, .6},
      {.4, .6},
      {.5, .6},
      {.6, .9},
      {.7, 1},
      {.8, 1},
      {.9, 1}},
     2.10,
     .4,
     .3},
    {"A2t",
     {{0, 0},
      {.1, .25},
      {.2, .5},
      {.3, .75},
      {.4, .75},
      {.5, .75},
      {.6, 1},
      {.7, 1},
      {.8, 1},
      {.9, 1}},
     2.50,
     .45,
     .25},
    {"A3", {{0, 0}, {.2, .4}, {.4, .4}, {.6, .8}, {.8, 1}}, 0.60, .2, .4},
    {"R2", {{0, 0}, {.2, .3}, {.4, .3}, {.4, .6}, {.6, .6}, {.8, .9}, {1, .9}}, 0.60, .2, .3},
    {"R4", {{0, 0}, {.25, .5}, {.5, 1}, {.75, 1}}, 1.00, .5, .5},
};

// A parallel that is ticked and runs on, or ends with `status`: with Success, all children have it.
void sample(Accumulator& measure, const std::vector<double>& progress,
            Status status = Status::Running) {
  const auto succeeded = std::make_unique<bool[]>(progress.size());
  std::fill_n(succeeded.get(), progress.size(), status == Status::Success);
  const SynchronizedTick tick{.ticked = true,
                              .status = status,
                              .progress = progress,
                              .succeeded = {succeeded.get(), progress.size()}};
  measure.after_tick({.parallels = {&tick, 1}});
}

TEST_CASE("progress distance of the worked traces") {
  for (const Trace& trace : kTraces) {
    INFO(trace.name);
    ProgressDistance distance({.children = 2});
    Spread spread({.children = 2});
    StepLength step({.children = 2});
    for (const auto& progress : trace.samples) {
      for (Accumulator* it :
           {static_cast<Accumulator*>(&distance), static_cast<Accumulator*>(&spread),
            static_cast<Accumulator*>(&step)}) {
        sample(*it, progress);
      }
    }
    const auto count = static_cast<double>(trace.samples.size());
    CHECK(distance.samples() == trace.samples.size());
    CHECK(distance.value({}) == Approx(trace.sum));
    CHECK(distance.mean() == Approx(trace.sum / count));
    CHECK(spread.value({}) == Approx(trace.largest_spread));
    CHECK(step.value({}) == Approx(trace.step));
  }
}

TEST_CASE("a parallel that no tick has reached has no measures") {
  const MeasureTarget target{.children = 3};
  const SynchronizedTick tick;
  ProgressDistance distance(target);
  Spread spread(target);
  StepLength step(target);
  for (Accumulator* it : {static_cast<Accumulator*>(&distance), static_cast<Accumulator*>(&spread),
                          static_cast<Accumulator*>(&step)}) {
    it->after_tick({.parallels = {&tick, 1}});
    CHECK(std::isnan(it->value({})));
    sample(*it, {0, 0, 1});
    CHECK_FALSE(std::isnan(it->value({})));
    it->reset();
    CHECK(std::isnan(it->value({})));
  }
  CHECK(distance.mean() == 0);
}

TEST_CASE("progress distance of some samples only") {
  const auto measured = [](std::uint64_t first, std::uint64_t last) {
    ProgressDistance distance({.children = 2}, {first, last});
    for (const auto& progress : kTraces[0].samples) sample(distance, progress);
    return distance.value({});
  };
  CHECK(measured(0, 9) == Approx(2.10));
  CHECK(measured(1, 2) == Approx(0.2 + 0.4));
  CHECK(measured(9, 9) == Approx(0.1));
  CHECK(measured(8, 20) == Approx(0.2 + 0.1));
  CHECK(std::isnan(measured(10, 20)));
}

TEST_CASE("a node that is held at a joint has its first step after its next tick") {
  StepLength step({.children = 1});
  step.join(Joint::Lost);
  const SynchronizedTick held{.status = Status::Running};
  step.after_tick({.parallels = {&held, 1}});
  sample(step, {0.8});
  CHECK(step.value({}) == 0);
  sample(step, {0.9});
  CHECK(step.value({}) == Approx(0.1));
}

TEST_CASE("no step leads from one activation to the next") {
  StepLength step({.children = 1});
  sample(step, {0.0});
  CHECK(step.value({}) == 0);
  sample(step, {0.9}, Status::Failure);
  sample(step, {0.0});
  CHECK(step.value({}) == Approx(0.9));
  sample(step, {0.05});
  CHECK(step.value({}) == Approx(0.9));
}

TEST_CASE("the last step of a child that succeeds leads to 1") {
  StepLength step({.children = 2});
  sample(step, {0.2, 1.0}, Status::Success);
  CHECK(step.value({}) == Approx(0.8));
}

TEST_CASE("a fall of progress is a step") {
  StepLength step({.children = 1});
  sample(step, {0.6});
  sample(step, {0.1});
  CHECK(step.value({}) == Approx(0.5));
}

}  // namespace
}  // namespace lockstep::host
