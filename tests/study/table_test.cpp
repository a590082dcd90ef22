// summary.csv from runs.csv, and the order and the seeds of the runs.
#include "study/table.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "study/row_text.h"
#include "study/study_case.h"

namespace lockstep::host::test {
namespace {

#define INTERVALS \
  "median-low,median-high,success-low,success-high,failure-low,failure-high,limit-low,limit-high"

// The columns of INTERVALS that are of shares: of so many successes, failures and limits.
std::string shares(std::uint64_t success, std::uint64_t failure, std::uint64_t limit) {
  std::string text;
  for (const std::uint64_t count : {success, failure, limit}) {
    const Interval it = share_interval(count, success + failure + limit);
    text += fmt::format("{}{},{}", text.empty() ? "" : ",", it.low, it.high);
  }
  return text;
}

StudyPlan plan_of(std::uint64_t runs) {
  StudyPlan plan;
  plan.runs = runs;
  plan.grid = {{GridAxis::Kind::Argument, "n", {"few", "many"}}};
  plan.max_ticks = 100;
  plan.columns = {{"progress-distance", "Main/sync"}};
  return plan;
}

// runs.csv with these values, row after row.
std::string runs_csv(const StudyPlan& plan, const std::vector<double>& values) {
  std::string lines;
  for (std::uint64_t row = 0; row < values.size(); ++row) {
    const StudyRow at = row_at(plan, row);
    append_row_beginning(row_cell(plan, at.cell), at.run, run_seed(plan, at), lines);
    append_row_end({.ticks = 7, .values = {values[row]}}, lines);
  }
  return row_header(plan) + lines;
}

}  // namespace

TEST_CASE("studies: the summary's quartiles are the medians of the halves") {
  const TemporaryDirectory directory;
  const StudyPlan plan = plan_of(5);
  const auto file =
      directory.file("runs.csv", runs_csv(plan, {10, 1, 4, 5, 2, std::nan(""), 8, 2, 1, 3}));
  const auto rows = summarize_study(file, plan).value();
  CHECK(summary_csv(plan, rows) ==
        "grid_n,node,measure,min,q1,median,q3,max,mean,n,runs,success,failure,limit,gap," INTERVALS
        "\n"
        "few,Main/sync,progress-distance,1,1.5,4,7.5,10,4.4,5,5,1,0,0,,,," +
            shares(5, 0, 0) +
            "\nmany,Main/sync,progress-distance,1,1.5,2.5,5.5,8,3.5,4,5,1,0,0,,,," +
            shares(5, 0, 0) + "\n");
}

TEST_CASE("studies: of six runs and more the median has an interval") {
  const TemporaryDirectory directory;
  const StudyPlan plan = plan_of(6);
  const auto file =
      directory.file("runs.csv", runs_csv(plan, {10, 1, 4, 5, 2, 7, 8, 2, 1, std::nan(""), 3, 9}));
  const auto rows = summarize_study(file, plan).value();
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].intervals()[0] == 1);
  CHECK(rows[0].intervals()[1] == 10);
  CHECK(rows[0].intervals()[2] == Approx(std::pow(0.025, 1 / 6.0)));
  CHECK(rows[0].intervals()[3] == 1);
  CHECK(contains(summary_csv(plan, rows), ",6,6,1,0,0,,1,10,0.54"));
  CHECK_FALSE(rows[1].intervals()[0].has_value());  // five values
}

TEST_CASE("studies: what no run reached has no numbers, and every run is counted") {
  const TemporaryDirectory directory;
  StudyPlan plan = plan_of(4);
  const std::string measure = "predictability:task@0.6";
  plan.columns = {{measure, "Main/task"}, {measure, "Main/task", true}};
  plan.columns.push_back({"progress-distance", "Main/sync", false, {0}});
  std::string lines;
  const double none = std::nan("");
  const auto add = [&](std::uint64_t row, StudyResult result, std::vector<double> values) {
    const StudyRow at = row_at(plan, row);
    append_row_beginning(row_cell(plan, at.cell), at.run, run_seed(plan, at), lines);
    const std::uint64_t ticks = result == StudyResult::Limit ? 100 : 7;
    append_row_end({.ticks = ticks, .result = result, .values = std::move(values)}, lines);
  };
  add(0, StudyResult::Success, {3, 0.01, 1});
  add(1, StudyResult::Failure, {5, 0.02, none});
  add(2, StudyResult::Limit, {none, 0.3, 2});
  add(3, StudyResult::Failure, {none, none, 3});
  for (std::uint64_t row = 4; row < 8; ++row) add(row, StudyResult::Failure, {none, 0.6, none});
  const auto file = directory.file("runs.csv", row_header(plan) + lines);
  const auto rows = summarize_study(file, plan).value();
  CHECK(summary_csv(plan, rows) ==
        "grid_n,node,measure,min,q1,median,q3,max,mean,n,runs,success,failure,limit,gap," INTERVALS
        "\n"
        "few,Main/task,predictability:task@0.6,3,3,4,5,5,4,2,4,0.25,0.5,0.25,0.02,,," +
            shares(1, 2, 1) +
            "\nfew,Main/sync,progress-distance,1,1,2,3,3,2,3,4,0.25,0.5,0.25,,,," +
            shares(1, 2, 1) + "\nmany,Main/task,predictability:task@0.6,,,,,,,0,4,0,1,0,0.6,,," +
            shares(0, 4, 0) + "\n");
  CHECK_FALSE(rows.at(0).is_far());
  CHECK(rows.at(2).is_far());
}

TEST_CASE("studies: a share is only 0 % of none and 100 % of all") {
  CHECK(percent(0, 5) == "0 %");
  CHECK(percent(5, 5) == "100 %");
  CHECK(percent(1003, 4800) == "20.9 %");
  CHECK(percent(1, 3) == "33.3 %");
  CHECK(percent(5, 100) == "5 %");
  CHECK(percent(1, 1001) == "<0.1 %");
  CHECK(percent(1000, 1001) == ">99.9 %");
  CHECK(to_text(ResultCounts{.runs = 4, .of = {3, 0, 1}}) == "success 75 %, limit 25 %");
}

TEST_CASE("studies: a summary of too few rows is none") {
  const TemporaryDirectory directory;
  const StudyPlan plan = plan_of(5);
  const auto file = directory.file("runs.csv", runs_csv(plan, {10, 1, 4}));
  CHECK(contains(summarize_study(file, plan).error().message, "has 3 of 10 runs"));
}

TEST_CASE("studies: parts make each run once, with a seed of its own") {
  StudyPlan plan = plan_of(23);
  std::set<std::pair<std::uint64_t, std::uint64_t>> seen;
  std::set<std::uint64_t> seeds;
  for (plan.shard = {1, 5}; plan.shard.part <= 5; ++plan.shard.part) {
    for (std::uint64_t row = 0; row < row_count(plan); ++row) {
      const StudyRow at = row_at(plan, row);
      CHECK(at.run % 5 == plan.shard.part - 1);
      seen.emplace(at.cell, at.run);
      seeds.insert(run_seed(plan, at));
    }
  }
  CHECK(seen.size() == 2 * 23);
  CHECK(seeds.size() == 2 * 23);
}

TEST_CASE("studies: no two columns have the same name") {
  StudyPlan plan = plan_of(1);  // with the grid name n, which the summary has too
  plan.grid.push_back({GridAxis::Kind::Seed, "seed", {"7"}});
  plan.grid.push_back({GridAxis::Kind::Argument, "grid_seed", {"8"}});
  plan.grid.push_back({GridAxis::Kind::Argument, "noise", {"0"}});
  CHECK(row_header(plan) ==
        "cell,grid_n,grid_grid_seed,grid_seed,noise,run,seed,ticks,result,progress-distance "
        "Main/sync\n");
  CHECK(summary_csv(plan, {}) ==
        "grid_n,grid_grid_seed,grid_seed,noise,node,measure,min,q1,median,q3,max,mean,n,runs,"
        "success,failure,limit,gap," INTERVALS "\n");
}

TEST_CASE("studies: a grid name seed or rate is in force in its cells") {
  StudyPlan plan = plan_of(1);
  plan.seed = 4;
  plan.grid.push_back({GridAxis::Kind::Seed, "seed", {"7", "8"}});
  plan.grid.push_back({GridAxis::Kind::Rate, "rate", {"50", "0.5"}});
  REQUIRE(cell_count(plan) == 8);
  CHECK(cell_text(plan, 6) == "n=many, seed=8, rate=50");
  CHECK(cell_seed(plan, 6) == 8);
  CHECK(cell_rate(plan, 6) == 50);
  CHECK(cell_rate(plan, 7) == 0.5);
  CHECK(cell_seed(plan_of(1), 0) == 0);
}

TEST_CASE("studies: names whose values belong together vary together") {
  StudyPlan plan = plan_of(1);
  plan.grid.push_back({GridAxis::Kind::Argument, "speed", {"1", "2", "2"}});
  plan.grid.push_back({GridAxis::Kind::Argument, "delta", {"x", "y", "z"}, true});
  plan.grid.push_back({GridAxis::Kind::Rate, "rate", {"50", "100"}});
  REQUIRE(cell_count(plan) == 2 * 3 * 2);
  CHECK(cell_text(plan, 0) == "n=few, speed=1, delta=x, rate=50");
  CHECK(cell_text(plan, 3) == "n=few, speed=2, delta=y, rate=100");
  CHECK(cell_text(plan, 4) == "n=few, speed=2, delta=z, rate=50");
  CHECK(cell_text(plan, 11) == "n=many, speed=2, delta=z, rate=100");
  CHECK(last_axes(plan.grid) == 1);
  plan.grid.pop_back();
  CHECK(last_axes(plan.grid) == 2);
  CHECK(last_axes({}) == 0);
}

}  // namespace lockstep::host::test
