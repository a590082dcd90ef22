// --until-ci: what is narrow, after which runs a cell is looked at, and what that does to the
// intervals.
#include "study/precision.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/core/random.h"
#include "study/row_sequence.h"

namespace lockstep::host {
namespace {

constexpr Precision kTenPercent{10, true};

StudyPlan plan_of(std::uint64_t runs, Precision precision) {
  StudyPlan plan;
  plan.runs = runs;
  plan.grid = {{GridAxis::Kind::Argument, "n", {"few", "many"}}};
  plan.columns = {{"duration", "Main"}};
  plan.precision = precision;
  return plan;
}

SampleSummary median(double low, double median, double high) {
  return {.count = 100, .median = median, .median_interval = Interval{low, high}};
}

RowResult row(double value) {
  return {.ticks = 1, .values = {value}};
}

// How many runs the first cell has with these values.
template <class Next>
std::uint64_t runs_of_cell(const StudyPlan& plan, Next next) {
  RowSequence rows(plan);
  while (rows.next() && rows.next()->cell == 0) rows.add(row(next()));
  return rows.count();
}

}  // namespace

TEST_CASE("precision: as it is written") {
  CHECK(precision_from("5%") == Precision{5, true});
  CHECK(precision_from("0.5") == Precision{0.5, false});
  for (const char* text : {"5%", "0.1%", "12.5", "1e-07"})
    CHECK(to_text(precision_from(text).value()) == text);
  for (const char* text : {"", "%", "0", "0%", "-5%", "5 %", "5%%", "five", "nan", "inf", "1e999"})
    CHECK_FALSE(precision_from(text).has_value());
}

TEST_CASE("precision: both ends of the interval are near the median") {
  const auto narrow = [](Precision precision, const SampleSummary& summary) {
    return is_narrow(precision, "duration", summary, {.runs = 100, .of = {50, 50, 0}});
  };
  CHECK(narrow(kTenPercent, median(18, 20, 22)));
  CHECK_FALSE(narrow(kTenPercent, median(17.9, 20, 22)));
  CHECK_FALSE(narrow(kTenPercent, median(18, 20, 22.1)));
  CHECK(narrow(kTenPercent, median(-22, -20, -18)));
  CHECK_FALSE(narrow(kTenPercent, median(-0.1, 0, 0.1)));  // of 0 there are no percent
  CHECK(narrow(kTenPercent, median(0, 0, 0)));
  CHECK(narrow({0.5, false}, median(-0.5, 0, 0.5)));
  CHECK_FALSE(narrow({0.5, false}, median(-0.5, 0, 0.6)));
  CHECK_FALSE(narrow({1000, false}, {.count = 5, .median = 3}));
}

TEST_CASE("precision: of the measure success it is that of the share") {
  const auto narrow = [](Precision precision, std::uint64_t successes, std::uint64_t runs) {
    return is_narrow(precision, "success", median(1, 1, 1),
                     {.runs = runs, .of = {successes, runs - successes, 0}});
  };
  CHECK_FALSE(narrow({5, true}, 150, 300));  // 44.2 to 55.8 %
  CHECK(narrow({5, true}, 210, 420));        // 45.1 to 54.9 %
  CHECK(narrow({0.05, false}, 210, 420));
  CHECK_FALSE(narrow({0.05, false}, 150, 300));
}

TEST_CASE("precision: a cell is looked at after 100 runs, then after a quarter more each time") {
  std::vector<std::uint64_t> looks;
  for (std::uint64_t runs = 0; runs < 400; looks.push_back(runs)) runs = next_look(runs);
  CHECK(looks == std::vector<std::uint64_t>{100, 125, 156, 195, 243, 303, 378, 472});
}

TEST_CASE("precision: a cell ends at a look, or after all runs") {
  const auto constant = [] { return 1.0; };
  const auto rising = [value = 1.0]() mutable { return value *= 1.1; };
  const auto settled = [run = 0]() mutable { return ++run <= 20 ? run * 1000.0 : 1.0; };
  CHECK(runs_of_cell(plan_of(99, kTenPercent), constant) == 99);
  CHECK(runs_of_cell(plan_of(1000, kTenPercent), constant) == 100);
  CHECK(runs_of_cell(plan_of(1000, kTenPercent), rising) == 1000);
  CHECK(runs_of_cell(plan_of(130, kTenPercent), rising) == 130);
  CHECK(runs_of_cell(plan_of(1000, kTenPercent), settled) == 100);
  CHECK(runs_of_cell(plan_of(1000, kTenPercent), [] { return std::nan(""); }) == 1000);
}

TEST_CASE("precision: the next cell begins with run 0, and the rest is not counted any more") {
  const StudyPlan plan = plan_of(1000, kTenPercent);
  RowSequence rows(plan);
  CHECK(rows.most() == 2000);
  CHECK(rows.last() == 100);
  for (int run = 0; run < 100; ++run) rows.add(row(1));
  CHECK(rows.next()->cell == 1);
  CHECK(rows.next()->run == 0);
  CHECK(rows.first() == 1000);
  CHECK(rows.last() == 1100);
  CHECK(rows.most() == 1100);
  CHECK(rows.is_open());
  for (int run = 0; run < 100; ++run) rows.add(row(1));
  CHECK_FALSE(rows.next());
  CHECK_FALSE(rows.is_open());
  CHECK(rows.count() == 200);
  CHECK(rows.most() == 200);
}

// docs/studies.md: at least 92 of 100. Exponential: far from symmetric, and not narrow at once.
TEST_CASE("precision: looking more than once costs little of the intervals' 95 %") {
  constexpr int kRepeats = 1000;
  RandomStream random(2021, 0);
  int contained = 0, looked_again = 0;
  const StudyPlan plan = plan_of(100'000, kTenPercent);
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    std::vector<double> values;
    runs_of_cell(plan, [&] { return values.emplace_back(-std::log1p(-random.next_double())); });
    const Interval it = summarize(values).median_interval.value();
    contained += it.low <= std::log(2.0) && std::log(2.0) <= it.high ? 1 : 0;
    looked_again += values.size() > 125 ? 1 : 0;
  }
  CHECK(looked_again > kRepeats / 2);
  CHECK(contained > 0.92 * kRepeats - 3 * std::sqrt(0.92 * 0.08 * kRepeats));
  CHECK(contained < 0.97 * kRepeats);
}

}  // namespace lockstep::host
