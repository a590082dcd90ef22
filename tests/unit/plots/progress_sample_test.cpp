// Which samples a picture needs, and that they give the same one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "study/plots/progress_sample.h"

namespace lockstep::host {
namespace {

ProgressSample sample(double time, double progress, bool held = false) {
  return {.time = time,
          .begins = time == 0,
          .least = progress,
          .progress = {progress},
          .held_until = {held ? time + 1 : time}};
}

// One a second, up and down; held in every third.
std::vector<ProgressSample> many(int count) {
  std::vector<ProgressSample> samples;
  for (int i = 0; i < count; ++i) {
    samples.push_back(sample(i, 0.5 + 0.5 * std::sin(0.01 * i), i % 3 == 0));
  }
  return samples;
}

struct Reached {
  double least = 1, most = 0;
};

// What the line reaches in each column.
std::vector<Reached> picture(const std::vector<ProgressSample>& samples, double end, int columns) {
  std::vector<Reached> reached(static_cast<std::size_t>(columns));
  for (const ProgressSample& it : samples) {
    Reached& column = reached[static_cast<std::size_t>(
        std::min(columns - 1, static_cast<int>(it.time / end * columns)))];
    column.least = std::min(column.least, it.progress[0]);
    column.most = std::max(column.most, it.progress[0]);
  }
  return reached;
}

double held(const std::vector<ProgressSample>& samples) {
  double sum = 0;
  for (const ProgressSample& it : samples) sum += std::max(0.0, it.held_until[0] - it.time);
  return sum;
}

TEST_CASE("few samples stay as they are") {
  std::vector<ProgressSample> samples = many(40);
  const auto before = samples;
  thin(samples, 10);
  REQUIRE(samples.size() == before.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(samples[i].time == before[i].time);
    CHECK(samples[i].progress == before[i].progress);
    CHECK(samples[i].held_until == before[i].held_until);
  }
}

TEST_CASE("many samples become four for each column, and give the same picture") {
  constexpr int kColumns = 100;
  std::vector<ProgressSample> samples = many(100'000);
  const double end = samples.back().time;
  const auto before = picture(samples, end, kColumns);
  const double held_before = held(samples);
  thin(samples, kColumns);
  CHECK(samples.size() == 4 * kColumns);
  CHECK(samples.front().time == 0);
  CHECK(samples.front().begins);
  CHECK(samples.back().time == end);
  CHECK(std::ranges::is_sorted(samples, {}, &ProgressSample::time));
  const auto after = picture(samples, end, kColumns);
  for (std::size_t column = 0; column < before.size(); ++column) {
    CHECK(after[column].least == before[column].least);
    CHECK(after[column].most == before[column].most);
  }
  CHECK(held(samples) == Approx(held_before));
  thin(samples, kColumns);  // what is thin stays as it is
  CHECK(samples.size() == 4 * kColumns);
  CHECK(held(samples) == Approx(held_before));
}

TEST_CASE("what is held without a break stays so, exactly") {
  std::vector<ProgressSample> samples;
  for (int i = 0; i < 1000; ++i) samples.push_back(sample(0.1 * i, 0.5));
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    samples[i].held_until[0] = samples[i + 1].time;
  }
  thin(samples, 10);
  REQUIRE(samples.size() == 40);
  for (std::size_t column = 0; column + 1 < 10; ++column) {
    CHECK(samples[4 * column].held_until[0] == samples[4 * column + 4].time);
  }
}

TEST_CASE("where an activation begins, no line leads, unless there are many in a column") {
  std::vector<ProgressSample> samples = many(1000);
  samples[50].begins = samples[350].begins = samples[700].begins = true;
  thin(samples, 10);
  REQUIRE(samples.size() == 48);
  std::vector<double> begins;
  for (const ProgressSample& it : samples) {
    if (it.begins) begins.push_back(it.time);
  }
  CHECK(begins == std::vector<double>{0, 50, 350, 700});
  samples = many(1000);
  for (ProgressSample& it : samples) it.begins = true;
  thin(samples, 10);
  REQUIRE(samples.size() == 40);
  for (std::size_t i = 0; i < samples.size(); ++i) CHECK(samples[i].begins == (i % 4 == 0));
}

TEST_CASE("times that go back or stand still are thinned too") {
  std::vector<ProgressSample> samples;
  for (int i = 0; i < 10'000; ++i) samples.push_back(sample(i % 2 == 0 ? 1e300 : 0, 0.5));
  thin(samples, 10);
  CHECK(samples.size() <= 40);
  samples.assign(1000, sample(7, 0.5));
  thin(samples, 10);
  CHECK(samples.size() == 4);
  samples.clear();
  thin(samples, 10);
  CHECK(samples.empty());
}

}  // namespace
}  // namespace lockstep::host
