// --rows: compressed rows are the rows; totals without rows are the same however the study is made,
// and its summary is that of the rows.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/compression/decompressed.h"
#include "study/study_case.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

Strings rows_study(const std::string& rows, const Strings& more = {}) {
  Strings arguments{kPaper + "example5.xml",
                    "--runs",
                    "4003",
                    "--grid",
                    "noise=0,0.05",
                    "--measure",
                    "progress-distance",
                    "--measure",
                    "ticks",
                    "--rows",
                    rows};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::string file_of(const std::string& rows) {
  return rows == "zst" ? "runs.csv.zst" : "cells.jsonl";
}

std::string all(const StudyCase& it, const std::string& out, const std::string& rows) {
  CHECK_FALSE(fs::exists(it.path(out) + "/cell.json"));
  return it.read(out, file_of(rows)) + it.read(out, "summary.csv") + it.read(out, "study.json");
}

std::string decompressed(const std::string& path) {
  DecompressedFile file(path);
  return {std::istreambuf_iterator<char>(file.text()), {}};
}

}  // namespace

TEST_CASE("rows: compressed they are the same rows, and the summary is the same") {
  const StudyCase it;
  it.make(rows_study("csv"), "csv");
  it.make(rows_study("zst"), "zst");
  CHECK(decompressed(it.path("zst/runs.csv.zst")) == it.read("csv", "runs.csv"));
  CHECK(it.read("zst", "summary.csv") == it.read("csv", "summary.csv"));
  CHECK(2 * fs::file_size(it.path("zst/runs.csv.zst")) < fs::file_size(it.path("csv/runs.csv")));
  const auto compare = [&](const std::string& out) {
    return run_lockstep({"study", "compare", it.path(out), "--cells", "0", "1"}).out;
  };
  CHECK(compare("zst") == compare("csv"));
}

TEST_CASE("rows: a run in which a measure has no value counts for none of its numbers") {
  const StudyCase it;
  write(it.path("late.xml"),
        R"(<root lockstep="1"><plugin name="motion"/><BehaviorTree ID="M"><Fallback memory="true">
           <Timeout seconds="0.05"><Advance step="0.2" noise="0.1"/></Timeout>
           <ParallelAbsolute name="p" barriers="0.5"><Advance step="0.1" noise="0.05"/><Advance step="0.2"/>
           </ParallelAbsolute></Fallback></BehaviorTree></root>)");
  for (const char* rows : {"csv", "none"}) {
    it.make({it.path("late.xml"), "--runs", "200", "--measure", "spread", "--rows", rows}, rows);
  }
  double sum = 0;
  int count = 0;
  for (const std::string& row : lines(it.read("csv", "runs.csv"))) {
    const std::string value = fields(row).back();
    if (value.empty() || std::isdigit(value.front()) == 0) continue;
    sum += std::stod(value);
    ++count;
  }
  CHECK(count > 10);
  CHECK(count < 190);
  const std::string summary = it.read("csv", "summary.csv");
  INFO(summary);
  CHECK(column(summary, "mean").at(0) == Approx(sum / count));
  CHECK(column(summary, "n").at(0) == count);
  const std::string without_rows = it.read("none", "summary.csv");  // its quartiles are near
  CHECK(column(without_rows, "mean") == column(summary, "mean"));
  CHECK(column(without_rows, "n") == column(summary, "n"));
}

TEST_CASE("rows: without them, quartiles are as near as promised and all else is the same") {
  const StudyCase it;
  it.make(rows_study("csv"), "csv");
  it.make(rows_study("none"), "none");
  CHECK_FALSE(fs::exists(it.path("none/runs.csv")));
  const std::string with = it.read("csv", "summary.csv"), without = it.read("none", "summary.csv");
  for (const char* name : {"min", "max", "mean", "n", "runs", "success", "success-low"})
    CHECK(column(without, name) == column(with, name));
  for (const char* name : {"q1", "median", "q3"}) {
    const auto near = column(without, name), exact = column(with, name);
    for (std::size_t row = 0; row < exact.size(); ++row)
      CHECK(std::abs(near[row] - exact[row]) <= exact[row] / 2048);
    CHECK(near[1] == exact[1]);  // ticks
    CHECK(near[3] == exact[3]);
  }
}

TEST_CASE("rows: threads, parts and interruptions change nothing") {
  for (const std::string rows : {"zst", "none"}) {
    INFO(rows);
    const StudyCase it;
    it.make(rows_study(rows, {"--jobs", "1"}), "one");
    const std::string expected = all(it, "one", rows);
    it.make(rows_study(rows, {"--jobs", "3"}), "three");
    CHECK(all(it, "three", rows) == expected);
    Strings parts;
    for (const char* part : {"1/3", "2/3", "3/3"}) {
      parts.push_back(std::string("part") + part[0]);
      it.make(rows_study(rows, {"--shard", part}), parts.back());
    }
    CHECK(it.merge(parts, "merged").code == 0);
    CHECK(all(it, "merged", rows) == expected);
    // After an end, there is nothing to do.
    it.make(rows_study(rows, {"--resume"}), "one");
    CHECK(all(it, "one", rows) == expected);
    // What is cut off is made again.
    const std::string results = it.read("one", file_of(rows));
    for (const std::size_t size : {results.size() - 1, results.size() / 2, std::size_t{3}}) {
      write(it.path("one/") + file_of(rows), results.substr(0, size));
      it.make(rows_study(rows, {"--resume"}), "one");
      CHECK(all(it, "one", rows) == expected);
    }
  }
}

TEST_CASE("rows: a cell that has begun goes on") {
  const StudyCase it;
  it.make(rows_study("none"), "out");
  it.make({kPaper + "example5.xml", "--runs", "2000", "--grid", "noise=0,0.05", "--measure",
           "progress-distance", "--measure", "ticks", "--rows", "none"},
          "some");
  // The first runs of a cell, as a signal leaves them.
  const std::string whole = it.read("out", "cells.jsonl"), expected = all(it, "out", "none");
  write(it.path("out/cells.jsonl"), whole.substr(0, whole.find('\n') + 1));
  write(it.path("out/cell.json"), lines(it.read("some", "cells.jsonl")).at(1) + '\n');
  it.make(rows_study("none", {"--resume"}), "out");
  CHECK(all(it, "out", "none") == expected);
  // Left behind by a kill: the cell has ended.
  write(it.path("out/cells.jsonl"), whole.substr(0, whole.find('\n') + 1));
  write(it.path("out/cell.json"), whole.substr(0, whole.find('\n') + 1));
  it.make(rows_study("none", {"--resume"}), "out");
  CHECK(all(it, "out", "none") == expected);
}

TEST_CASE("rows: damage is refused") {
  const StudyCase it;
  it.make(rows_study("none"), "out");
  const std::string good = it.read("out", "cells.jsonl");
  const auto refused = [&](const std::string& from, const std::string& to) {
    INFO(from);
    std::string bad = good;
    bad.replace(bad.find(from), from.size(), to);
    write(it.path("out/cells.jsonl"), bad);
    const Outcome outcome = it.study(rows_study("none", {"--resume"}), "out");
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "cells.jsonl', line 1: "));
  };
  refused("4003", "4002");
  refused("{\"cell\":0", "{\"cell\":1");
  refused("buckets", "bucket");
  refused("\"sum\":\"", "\"sum\":\"0");
  refused("100.0", "100.00");
}

TEST_CASE("rows: what needs them says so") {
  const StudyCase it;
  it.make(rows_study("none"), "none");
  const Outcome compared = run_lockstep({"study", "compare", it.path("none"), "--cells", "0", "1"});
  CHECK(compared.code == 2);
  CHECK(contains(compared.err, "has no rows, which the tests need\n  hint: make it without"));
  CHECK(contains(it.study(rows_study("none", {"--until-ci", "5%"}), "until").err,
                 "--rows none: with --until-ci the values of all runs"));
  CHECK(contains(it.study(rows_study("csv", {"--resume"}), "none").err, "its 'rows' differs"));
  CHECK_FALSE(fs::exists(it.path("none/runs.csv")));
}

}  // namespace lockstep::host::test
