#include "measure/progress_distance.h"

#include <catch2/catch.hpp>
#include <string>

namespace lockstep {
namespace {

double distance(std::vector<double> progress) {
  std::vector<double> scratch(progress.size());
  return progress_distance(progress, scratch);
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

TEST_CASE("progress distance of the worked traces") {
  for (const Trace& trace : kTraces) {
    INFO(trace.name);
    ProgressDistance measured(2);
    for (const auto& sample : trace.samples) measured.sample(sample);
    const auto count = static_cast<double>(trace.samples.size());
    CHECK(measured.samples() == trace.samples.size());
    CHECK(measured.sum() == Approx(trace.sum));
    CHECK(measured.mean() == Approx(trace.sum / count));
    CHECK(measured.largest_spread() == Approx(trace.largest_spread));
    CHECK(measured.step_length() == Approx(trace.step));
  }
}

TEST_CASE("progress distance without samples is zero") {
  const ProgressDistance measured(3);
  CHECK(measured.samples() == 0);
  CHECK(measured.mean() == 0);
}

TEST_CASE("no step leads from one activation to the next") {
  ProgressDistance measured(1);
  measured.sample(std::vector{0.0});
  measured.sample(std::vector{0.9});
  measured.begin_activation();
  measured.sample(std::vector{0.0});
  CHECK(measured.step_length() == Approx(0.9));
  measured.sample(std::vector{0.05});
  CHECK(measured.step_length() == Approx(0.9));
}

TEST_CASE("the last step of a node that succeeds leads to 1") {
  ProgressDistance measured(2);
  measured.sample(std::vector{0.2, 1.0});
  measured.succeeded();
  CHECK(measured.step_length() == Approx(0.8));
  CHECK(measured.samples() == 1);
}

TEST_CASE("a fall of progress is a step") {
  ProgressDistance measured(1);
  measured.sample(std::vector{0.6});
  measured.sample(std::vector{0.1});
  CHECK(measured.step_length() == Approx(0.5));
}

}  // namespace
}  // namespace lockstep
