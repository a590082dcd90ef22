// However a study is made, at once or in parts, on one thread or many, with or without a kill in
// between: the bytes are the same.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "study/study_case.h"
#include "support/paths.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

// 4 cells of 23 runs: neither chunks nor shards come out even.
const Strings kStudy{kPaper + "example5.xml",
                     "--runs",
                     "23",
                     "--grid",
                     "barrier_count=0,5",
                     "--grid",
                     "noise=0.01,0.05",
                     "--measure",
                     "progress-distance",
                     "--measure",
                     "predictability:a1@0.6=60"};

}  // namespace

TEST_CASE("a study is the same twice, and on one thread or several") {
  const StudyCase it;
  it.make(with(kStudy, {"--jobs", "1"}), "one");
  it.make(with(kStudy, {"--jobs", "1"}), "again");
  it.make(with(kStudy, {"--jobs", "2"}), "two");
  it.make(with(kStudy, {"--jobs", "7"}), "seven");
  CHECK(it.bytes("one") == it.bytes("again"));
  CHECK(it.bytes("one") == it.bytes("two"));
  CHECK(it.bytes("one") == it.bytes("seven"));
  it.make(with(kStudy, {"--seed", "8"}), "other");
  CHECK(it.read("one", "runs.csv") != it.read("other", "runs.csv"));
}

TEST_CASE("a study has a row for each run of each cell, the first name varies slowest") {
  const StudyCase it;
  it.make(kStudy, "out");
  const auto rows = lines(it.read("out", "runs.csv"));
  REQUIRE(rows.size() == 1 + 4 * 23);
  CHECK(rows[0] ==
        "cell,barrier_count,noise,run,seed,ticks,result,progress-distance Example5/parallel,"
        "predictability:a1@0.6=60 Example5/parallel/a1,"
        "gap predictability:a1@0.6=60 Example5/parallel/a1");
  CHECK(rows[1].starts_with("0,0,0.01,0,"));
  CHECK(rows[23].starts_with("0,0,0.01,22,"));
  CHECK(rows[24].starts_with("1,0,0.05,0,"));
  CHECK(rows[47].starts_with("2,5,0.01,0,"));
  CHECK(rows[92].starts_with("3,5,0.05,22,"));
  const auto summary = lines(it.read("out", "summary.csv"));
  REQUIRE(summary.size() == 1 + 4 * 2);
  CHECK(summary[0] ==
        "barrier_count,noise,node,measure,min,q1,median,q3,max,mean,n,runs,success,failure,limit,"
        "gap,median-low,median-high,success-low,success-high,failure-low,failure-high,limit-low,"
        "limit-high");
  CHECK(summary[1].starts_with("0,0.01,Example5/parallel,progress-distance,"));
  CHECK(contains(summary[1], ",23,23,1,0,0,,"));
}

TEST_CASE("a grid over the study's seed has a column of its own, beside the seed of each run") {
  const StudyCase it;
  const Strings arguments{kPaper + "example5.xml", "--runs", "2", "--grid", "seed=1,2"};
  it.make(arguments, "out");
  const std::string runs = it.read("out", "runs.csv");
  CHECK(runs.starts_with("cell,grid_seed,run,seed,ticks,result,"));
  CHECK(column(runs, "grid_seed") == std::vector<double>{1, 1, 2, 2});
  CHECK(it.read("out", "summary.csv").starts_with("grid_seed,node,measure,"));
  const Outcome printed = it.study(arguments, "printed");
  CHECK(contains(printed.out, "\ngrid_seed  "));
}

TEST_CASE("parts put together are the study that one machine makes") {
  const StudyCase it;
  it.make(kStudy, "whole");
  for (const std::string part : {"1", "2", "3", "4", "5"}) {
    it.make(with(kStudy, {"--shard", part + "/5"}), "part" + part);
  }
  // In any order.
  const Outcome merged = it.merge({"part3", "part1", "part5", "part2", "part4"}, "merged");
  INFO(merged.err);
  CHECK(merged.code == 0);
  CHECK(it.bytes("merged") == it.bytes("whole"));
}

TEST_CASE("a grid of ranges and of names with values together can be cut and parted") {
  const StudyCase it;
  const Strings study{kPaper + "example5.xml",
                      "--runs",
                      "5",
                      "--grid",
                      "seed=1:3:2",
                      "--grid",
                      "noise,barrier_count=0.01:0,0.05:0,0.05:20"};
  it.make(study, "whole");
  const auto rows = lines(it.read("whole", "runs.csv"));
  REQUIRE(rows.size() == 1 + 2 * 3 * 5);
  CHECK(rows[0].starts_with("cell,grid_seed,noise,barrier_count,run,seed,"));
  CHECK(rows[1].starts_with("0,1,0.01,0,0,"));
  CHECK(rows[11].starts_with("2,1,0.05,20,0,"));
  CHECK(rows[30].starts_with("5,3,0.05,20,4,"));
  for (const std::string part : {"1", "2"}) it.make(with(study, {"--shard", part + "/2"}), part);
  const Outcome merged = it.merge({"2", "1"}, "merged");
  INFO(merged.err);
  CHECK(merged.code == 0);
  CHECK(it.bytes("merged") == it.bytes("whole"));
  fs::create_directory(it.path("cut"));
  write(it.path("cut/study.json"), it.read("whole", "study.json"));
  write(it.path("cut/runs.csv"), it.read("whole", "runs.csv").substr(0, 400));
  it.make(with(study, {"--resume"}), "cut");
  CHECK(it.bytes("cut") == it.bytes("whole"));
  // All combinations are another study than pairs of the same values.
  CHECK(it.study({kPaper + "example5.xml", "--runs", "5", "--grid", "seed=1,3", "--grid",
                  "noise=0.01,0.05", "--grid", "barrier_count=0,20", "--resume"},
                 "whole")
            .code == 2);
}

TEST_CASE("a study.json whose names do not go together is refused") {
  const StudyCase it;
  const Strings study{kPaper + "example5.xml", "--runs", "1", "--grid",
                      "noise,barrier_count=0.01:0,0.05:20"};
  it.make(study, "out");
  const std::string good = it.read("out", "study.json");
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& why) {
    std::string text = good;
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
    write(it.path("out/study.json"), text);
    const Outcome outcome = it.study(with(study, {"--resume"}), "out");
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, why));
  };
  const std::string together = ",\n      \"together_with\": \"noise\"";
  refused(together, "", "its 'grid' differs");
  refused(together, ",\n      \"together_with\": \"rate\"", "not as lockstep wrote it");
  refused("\"0.01\",", "\"0.01\", \"0.02\",", "do not have as many values");
  refused("\"0.05\"\n      ]", "\"0.05\"\n      ]" + together, "'noise' in 'grid' follows nothing");
}

TEST_CASE("a paired study has the same seed for a run in all cells, and in parts and after a cut") {
  const StudyCase it;
  const Strings paired = with(kStudy, {"--paired"});
  it.make(kStudy, "plain");
  it.make(paired, "whole");
  const auto plain = lines(it.read("plain", "runs.csv"));
  const auto rows = lines(it.read("whole", "runs.csv"));
  REQUIRE(rows.size() == 1 + 4 * 23);
  const auto seed_of = [](const std::vector<std::string>& all, std::size_t row) {
    return fields(all[row]).at(4);
  };
  for (std::size_t run = 1; run <= 23; ++run) {
    CHECK(rows[run] == plain[run]);
    CHECK(seed_of(plain, run) != seed_of(plain, 23 + run));
    if (run > 1) CHECK(seed_of(rows, run) != seed_of(rows, run - 1));
    for (std::size_t cell = 1; cell < 4; ++cell)
      CHECK(seed_of(rows, 23 * cell + run) == seed_of(rows, run));
  }
  CHECK(contains(it.read("whole", "study.json"), "\n  \"paired\": true\n}\n"));
  for (const std::string part : {"1", "2"}) it.make(with(paired, {"--shard", part + "/2"}), part);
  CHECK(it.merge({"1", "2"}, "merged").code == 0);
  CHECK(it.bytes("merged") == it.bytes("whole"));
  fs::create_directory(it.path("cut"));
  write(it.path("cut/study.json"), it.read("whole", "study.json"));
  write(it.path("cut/runs.csv"), it.read("whole", "runs.csv").substr(0, 2000));
  for (const Outcome& other : {it.study(with(kStudy, {"--resume"}), "cut"),
                               it.study(with(paired, {"--resume"}), "plain")}) {
    CHECK(other.code == 2);
    CHECK(contains(other.err, "its 'paired' differs"));
  }
  it.make(with(paired, {"--resume"}), "cut");
  CHECK(it.bytes("cut") == it.bytes("whole"));
  it.make(with(kStudy, {"--shard", "2/2"}), "unpaired part");
  CHECK(contains(it.merge({"1", "unpaired part"}, "no").err, "its 'paired' differs"));
}

TEST_CASE("a paired study over seeds pairs the cells of each seed") {
  const StudyCase it;
  it.make({kPaper + "example5.xml", "--runs", "3", "--paired", "--grid", "seed=1,2", "--grid",
           "barrier_count=0,5"},
          "out");
  const auto seeds = [&](std::size_t cell) {
    std::vector<std::string> of_cell;
    const auto rows = lines(it.read("out", "runs.csv"));
    for (std::size_t run = 0; run < 3; ++run)
      of_cell.push_back(fields(rows.at(1 + 3 * cell + run)).at(5));
    return of_cell;
  };
  CHECK(seeds(0) == seeds(1));
  CHECK(seeds(2) == seeds(3));
  CHECK(seeds(0) != seeds(2));
}

TEST_CASE("parts that do not fit together are refused, and why is said") {
  const StudyCase it;
  it.make(with(kStudy, {"--shard", "1/2"}), "a");
  it.make(with(kStudy, {"--shard", "2/2"}), "b");
  it.make(with(kStudy, {"--shard", "2/3"}), "third");
  it.make(with(kStudy, {"--shard", "2/2", "--seed", "8"}), "seed");
  const auto refused = [&](Strings parts, const std::string& why) {
    const Outcome outcome = it.merge(std::move(parts), "merged");
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, why));
    CHECK_FALSE(fs::exists(it.path("merged/summary.csv")));
  };
  refused({"a"}, "of 2 parts these are missing: 2");
  refused({"a", "a"}, "are both part 1 of 2");
  refused({"a", "third"}, "is one of 3 parts");
  refused({"a", "seed"}, "its 'seed' differs");
  refused({"a", "nowhere"}, "is not a study");
  const std::string rows = it.read("b", "runs.csv");
  write(it.path("b/runs.csv"), rows.substr(0, rows.size() / 2));
  refused({"a", "b"}, "is not finished: it has");
  CHECK_FALSE(fs::exists(it.path("merged")));
  fs::create_directory(it.path("merged"));
  refused({"a", "b"}, "is not finished: it has");
  CHECK(fs::is_empty(it.path("merged")));
}

// What the other process has locked may be a directory in which nothing is written yet.
TEST_CASE("a study waits for the lock before it writes anything") {
  const StudyCase it;
  fs::create_directory(it.path("out"));
  it.file("out/runs.csv", "");
  const int other = open(it.path("out/runs.csv").c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(flock(other, LOCK_EX) == 0);
  for (const Strings& arguments : {kStudy, with(kStudy, {"--resume"})}) {
    const Outcome outcome = it.study(arguments, "out");
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "another process is writing the study in"));
    CHECK_FALSE(fs::exists(it.path("out/study.json")));
  }
  close(other);
  it.make(kStudy, "out");
}

TEST_CASE("a study cut at any byte goes on to the same bytes") {
  const StudyCase it;
  it.make(kStudy, "whole");
  const std::string rows = it.read("whole", "runs.csv");
  const std::size_t header = rows.find('\n') + 1;
  const std::size_t line = rows.find('\n', header) + 1;
  for (const std::size_t cut :
       {std::size_t{0}, std::size_t{5}, header - 1, header, header + 1, line - 1, line, line + 3,
        rows.size() / 3, rows.size() / 2, rows.size() - 1, rows.size()}) {
    fs::remove_all(it.path("cut"));
    fs::copy(it.path("whole"), it.path("cut"));
    fs::remove(it.path("cut/summary.csv"));
    write(it.path("cut/runs.csv"), rows.substr(0, cut));
    INFO("cut at " << cut);
    it.make(with(kStudy, {"--resume"}), "cut");
    CHECK(it.bytes("cut") == it.bytes("whole"));
  }
}

TEST_CASE("a kill before there was anything to run leaves a directory to begin in") {
  const StudyCase it;
  it.make(with(kStudy, {"--resume"}), "whole");  // nothing there yet is no error
  fs::create_directory(it.path("cut"));
  write(it.path("cut/study.json.new"), "{\"lockstep_st");
  it.make(with(kStudy, {"--resume"}), "cut");
  CHECK(it.bytes("cut") == it.bytes("whole"));
}

TEST_CASE("a directory with something else in it is left alone") {
  const StudyCase it;
  it.make(kStudy, "out");
  const std::string before = it.bytes("out");
  const auto refused = [&](const Strings& arguments, const std::string& out,
                           const std::string& why) {
    const Outcome outcome = it.study(arguments, out);
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, why));
  };
  refused(kStudy, "out", "continue it with --resume");
  refused(with(kStudy, {"--resume", "--seed", "8"}), "out", "its 'seed' differs");
  refused(with(kStudy, {"--resume", "--shard", "1/2"}), "out", "its 'shard' differs");
  CHECK(it.bytes("out") == before);

  fs::create_directory(it.path("photos"));
  it.file("photos/cat", "");
  refused(kStudy, "photos", "is not empty and not a study");
  CHECK_FALSE(fs::exists(it.path("photos/study.json")));

  std::string rows = it.read("out", "runs.csv");
  rows.replace(rows.find("\n1,") + 1, 1, "3");
  write(it.path("out/runs.csv"), rows);
  refused(with(kStudy, {"--resume"}), "out", "line 25: not a row");
}

TEST_CASE("a study that a signal ends goes on to the same bytes") {
  const StudyCase it;
  const Strings study{kPaper + "example5.xml", "--runs", "60000", "--jobs", "2"};
  it.make(study, "whole");
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGKILL}) {
    fs::remove_all(it.path("cut"));
    Process process({.arguments = with({"study", "--no-plots", "--out", it.path("cut")}, study)},
                    Process::Output::Terminal);
    REQUIRE(process.wait_for("runs/s"));
    process.signal(number);
    const Outcome outcome = process.finish();
    CHECK(outcome.code == 128 + number);
    if (number != SIGKILL)
      CHECK(contains(outcome.out, "continue with the same command and --resume"));
    CHECK_FALSE(fs::exists(it.path("cut/summary.csv")));
    CHECK(it.read("cut", "runs.csv").size() < it.read("whole", "runs.csv").size());
    it.make(with(study, {"--resume"}), "cut");
    CHECK((it.bytes("cut") == it.bytes("whole")));  // not printed: megabytes
  }
}

TEST_CASE("a study in parts works under GNU parallel") {
  const StudyCase it;
  it.make(kStudy, "whole");
  std::string command = LOCKSTEP_BINARY_DIR "/lockstep study";
  for (const std::string& argument : kStudy) command += ' ' + argument;
  command += " --jobs 1 --no-plots --shard {}/4 --out " + it.path("part-{}");
  const Outcome made = run({.arguments = {"--will-cite", "-j2", command, ":::", "1", "2", "3", "4"},
                            .program = "parallel"});
  INFO(made.err);
  REQUIRE(made.code == 0);
  CHECK(it.merge({"part-1", "part-2", "part-3", "part-4"}, "merged").code == 0);
  CHECK(it.bytes("merged") == it.bytes("whole"));
}

}  // namespace lockstep::host::test
