// --until-ci: each cell has as many runs as it needs, and the bytes are the same however the study
// is made.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>

#include "study/study_case.h"
#include "support/json.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

// Without noise 100 runs are enough, with 0.01 some more, with 0.2 there are none too many.
Strings until_study(const Strings& more = {"--until-ci", "5%"}) {
  Strings arguments{kPaper + "example5.xml", "--runs", "400", "--grid", "noise=0,0.01,0.2"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::map<double, std::size_t> runs_of_cells(const std::string& runs_csv) {
  std::map<double, std::size_t> runs;
  for (const double cell : column(runs_csv, "cell")) ++runs[cell];
  return runs;
}

}  // namespace

TEST_CASE("until a precision, each cell has the runs that it needs, the first of a longer study") {
  const StudyCase it;
  it.make(until_study({}), "all");
  const Outcome outcome = it.study(until_study(), "out");
  CHECK(outcome.code == 0);
  const auto runs = runs_of_cells(it.read("out", "runs.csv"));
  CHECK(runs.at(0) == 100);
  CHECK(runs.at(1) == 100);
  CHECK(runs.at(2) == 400);
  const auto all = lines(it.read("all", "runs.csv")), some = lines(it.read("out", "runs.csv"));
  REQUIRE(all.size() == 1 + 3 * 400);
  for (std::size_t row = 0; row < 100; ++row) {
    CHECK(some[1 + row] == all[1 + row]);
    CHECK(some[101 + row] == all[401 + row]);
  }
  const std::string summary = it.read("out", "summary.csv");
  CHECK(column(summary, "runs") == std::vector<double>{100, 100, 400});
  const auto medians = column(summary, "median"), lows = column(summary, "median-low"),
             highs = column(summary, "median-high");
  for (const std::size_t cell : {0, 1}) {
    CHECK(highs[cell] <= 1.05 * medians[cell]);
    CHECK(lows[cell] >= 0.95 * medians[cell]);
  }
  CHECK(contains(outcome.err,
                 "warning: 'progress-distance' of 'Example5/parallel': in 1 of 3 cells the "
                 "interval is not as narrow as 5%, after all 400 runs"));
  CHECK(contains(it.read("out", "study.json"), "\n  \"until_ci\": \"5%\"\n}\n"));
}

TEST_CASE("until a precision, the narrower one needs more runs, and every measure counts") {
  const StudyCase it;
  const auto runs_with = [&](const Strings& more) {
    fs::remove_all(it.path("out"));
    it.make(until_study(with({"--grid", "barrier_count=5"}, more)), "out");
    return runs_of_cells(it.read("out", "runs.csv")).at(1);
  };
  CHECK(runs_with({"--until-ci", "5%"}) == 100);
  CHECK(runs_with({"--until-ci", "2.2%"}) > 100);
  CHECK(runs_with({"--until-ci", "2.2%"}) < 400);
  CHECK(runs_with({"--until-ci", "0.3%"}) == 400);
  CHECK(runs_with({"--until-ci", "20", "--measure", "ticks"}) == 100);
  CHECK(runs_with({"--until-ci", "20", "--measure", "ticks", "--measure", "spread"}) == 100);
  CHECK(runs_with({"--until-ci", "0.001", "--measure", "spread"}) == 400);
  CHECK(runs_with({"--until-ci", "0.04", "--measure", "success", "--measure",
                   "progress-distance"}) == 400);
  CHECK(runs_with({"--until-ci", "5%", "--measure", "success"}) == 100);  // 96.4 to 100 %
  CHECK(runs_with({"--until-ci", "0.9%", "--measure", "success"}) == 400);
}

TEST_CASE("until a precision, the bytes are the same on any number of threads") {
  const StudyCase it;
  for (const Strings& more :
       {Strings{"--until-ci", "2%"}, Strings{"--until-ci", "2%", "--paired"}}) {
    for (const std::string jobs : {"1", "2", "7", "64"}) {
      fs::remove_all(it.path(jobs));
      it.make(until_study(with(more, {"--jobs", jobs})), jobs);
      CHECK(it.bytes(jobs) == it.bytes("1"));
    }
  }
}

TEST_CASE("until a precision, a study cut at any byte goes on to the same bytes") {
  const StudyCase it;
  it.make(until_study(), "whole");
  const std::string rows = it.read("whole", "runs.csv");
  const auto line = [&](std::size_t number) {
    std::size_t at = 0;
    while (number-- > 0) at = rows.find('\n', at) + 1;
    return at;
  };
  for (const std::size_t cut : {std::size_t{0}, line(1), line(60), line(100) - 1, line(101) - 1,
                                line(101), line(101) + 1, line(102), line(201) - 1, line(201),
                                line(201 + 125), line(201 + 130), rows.size() - 1, rows.size()}) {
    fs::remove_all(it.path("cut"));
    fs::copy(it.path("whole"), it.path("cut"));
    fs::remove(it.path("cut/summary.csv"));
    write(it.path("cut/runs.csv"), rows.substr(0, cut));
    INFO("cut at " << cut);
    it.make(with(until_study(), {"--resume", "--jobs", "3"}), "cut");
    CHECK(it.bytes("cut") == it.bytes("whole"));
  }
}

TEST_CASE("until a precision, a study that a signal ends goes on to the same bytes") {
  const StudyCase it;
  Strings study{kPaper + "example5.xml", "--runs", "60000", "--until-ci", "0.001%"};
  study = with(study, {"--grid", "noise=0,0.2", "--jobs", "2"});
  it.make(study, "whole");
  REQUIRE(runs_of_cells(it.read("whole", "runs.csv")).at(1) == 60000);
  Process process({.arguments = with({"study", "--no-plots", "--out", it.path("cut")}, study)},
                  Process::Output::Terminal);
  REQUIRE(process.wait_for("of at most"));
  process.signal(SIGINT);
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 130);
  CHECK(contains(outcome.out, "continue with the same command and --resume"));
  it.make(with(study, {"--resume"}), "cut");
  CHECK((it.bytes("cut") == it.bytes("whole")));  // not printed: megabytes
}

TEST_CASE("until a precision, a file in which a cell ends too early or too late is refused") {
  const StudyCase it;
  it.make(until_study({}), "all");
  it.make(until_study(), "whole");
  const auto rows = lines(it.read("whole", "runs.csv")), all = lines(it.read("all", "runs.csv"));
  const auto refused = [&](std::size_t from, std::size_t to, const std::string& instead,
                           const std::string& why) {
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == from) text += instead;
      if (i < from || i >= to) text += rows[i] + '\n';
    }
    fs::remove_all(it.path("bad"));
    fs::copy(it.path("whole"), it.path("bad"));
    write(it.path("bad/runs.csv"), text);
    for (const Outcome& outcome :
         {it.merge({"bad"}, "merged"), it.study(with(until_study(), {"--resume"}), "bad")}) {
      INFO(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, why));
    }
  };
  refused(100, 101, "", "line 101: not a row");                  // the first cell has 99 runs
  refused(101, 101, all.at(101) + '\n', "line 102: not a row");  // 101 runs
  std::string half;
  for (std::size_t i = 0; i < 301; ++i) half += rows[i] + '\n';
  write(it.path("whole/runs.csv"), half);
  const Outcome merged = it.merge({"whole"}, "merged");
  CHECK(merged.code == 2);
  CHECK(contains(merged.err, "is not finished: it has 300 of at most 600 runs"));
}

TEST_CASE("until a precision, there are no parts, and another precision is another study") {
  const StudyCase it;
  it.make(until_study(), "out");
  const Outcome part = it.study(until_study({"--until-ci", "5%", "--shard", "1/2"}), "part");
  CHECK(part.code == 2);
  CHECK(contains(part.err, "--until-ci: such a study has no parts"));
  CHECK_FALSE(fs::exists(it.path("part")));
  for (const Strings& other :
       {Strings{}, Strings{"--until-ci", "6%"}, Strings{"--until-ci", "5"}}) {
    const Outcome outcome = it.study(with(until_study(other), {"--resume"}), "out");
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "its 'until_ci' differs"));
  }
  CHECK(it.merge({"out"}, "merged").code == 0);
  CHECK(it.bytes("merged") == it.bytes("out"));
}

TEST_CASE("until a precision, cells of one study may have another number of pairs") {
  const StudyCase it;
  it.make(until_study({"--until-ci", "5%", "--paired"}), "out");
  const Outcome outcome =
      run_lockstep({"study", "compare", it.path("out"), "--json", "--cells", "0", "2"});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto distance = parse_json(outcome.out)["measures"][0];
  CHECK(distance["n_a"] == 100);
  CHECK(distance["n_b"] == 100);
}

}  // namespace lockstep::host::test
