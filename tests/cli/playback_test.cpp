// The leaf Recorded of the plugin motion: what one run has recorded, another one plays.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// Status and progress of a node in each tick until it succeeds, as log csv has them.
std::vector<std::string> played(const std::string& recording, const std::string& path) {
  const Outcome outcome = run_lockstep({"log", "csv", recording});
  CHECK(outcome.code == 0);
  std::vector<std::string> rows;
  for (const std::string& row : lines(outcome.out)) {
    const auto at = row.find("," + path + ",");
    if (at == std::string::npos) continue;
    const std::string rest = row.substr(at + path.size() + 2);  // status,progress,ticked,held
    rows.push_back(rest.substr(0, rest.find(',', rest.find(',') + 1)));
    if (rest.starts_with("success")) break;
  }
  return rows;
}

Outcome record(const TemporaryDirectory& directory, const std::string& nodes,
               const std::string& file) {
  const std::string tree = directory.file(file + ".xml", tree_text(nodes));
  return run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--seed", "3",
                       "--record", directory.path(file)});
}

}  // namespace

TEST_CASE("Recorded has the progress of the recorded node in every tick") {
  const TemporaryDirectory directory;
  const std::string node = "Main/ParallelAbsolute/b";
  for (const auto& [clock, name] : {std::pair<std::string, std::string>{"ticks", "real.jsonl"},
                                    {"time", "real.jsonl"},
                                    {"ticks", "real.jsonl.zst"}}) {
    INFO(clock << " " << name);
    REQUIRE(record(directory,
                   "<ParallelAbsolute barriers=\"0.5;1\"><Advance name=\"a\" step=\"0.1\"/>"
                   "<Sequence name=\"b\" memory=\"true\"><Advance step=\"0.2\" noise=\"0.1\"/>"
                   "<Advance step=\"0.3\"/></Sequence></ParallelAbsolute>",
                   name)
                .code == 0);
    const Outcome outcome =
        record(directory,
               "<Parallel><Wait seconds=\"0.01\"/><Recorded name=\"r\" clock=\"" + clock +
                   "\" file=\"" + directory.path(name) + "\" node=\"" + node + "\"/></Parallel>",
               clock + ".jsonl");
    CHECK(outcome.err.empty());
    CHECK(outcome.code == 0);
    const auto real = played(directory.path(name), node);
    REQUIRE(real.size() > 5);
    CHECK(played(directory.path(clock + ".jsonl"), "Main/Parallel/r") == real);
  }
}

TEST_CASE("Recorded plays a long recording to its end, plain or compressed") {
  const TemporaryDirectory directory;
  const std::string node = "Main/Parallel/a";
  for (const std::string name : {"long.jsonl", "long.jsonl.zst"}) {
    REQUIRE(record(directory,
                   "<Parallel><Advance name=\"a\" step=\"0.0002\" noise=\"0.0001\"/>"
                   "<Advance name=\"b\" step=\"0.0002\" noise=\"0.0001\"/></Parallel>",
                   name)
                .code == 0);
    const std::string file = directory.path(name);
    CHECK(read_file(file).size() > (64u << 10));
    REQUIRE(record(directory, "<Recorded name=\"r\" file=\"" + file + "\" node=\"" + node + "\"/>",
                   "again.jsonl")
                .code == 0);
    CHECK(played(directory.path("again.jsonl"), "Main/r") == played(file, node));
  }
}

TEST_CASE(
    "Recorded plays an activation in several files when they are joined, and reports one of them") {
  const TemporaryDirectory directory;
  const std::string node = "Main/a", whole = directory.path("whole.jsonl");
  const std::string tree =
      directory.file("tree.xml", tree_text("<Advance name=\"a\" step=\"0.05\" noise=\"0.02\"/>"));
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--rate", "10", "--record",
                        directory.path("run.jsonl"), "--record-rotate", "0.7s"})
              .code == 0);
  const auto join = [&] {
    std::ofstream(whole) << run_lockstep({"log", "cat", directory.path("run.jsonl")}).out;
  };
  const auto play = [&](const std::string& file) {
    const std::string player = directory.file(
        "play.xml",
        tree_text("<Recorded name=\"r\" file=\"" + file + "\" node=\"" + node + "\"/>"));
    return run_lockstep({"run", player, "--clock", "virtual", "--view", "none", "--max-ticks", "60",
                         "--record", directory.path("again.jsonl")});
  };
  join();
  Outcome outcome = play(whole);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(played(directory.path("again.jsonl"), "Main/r") == played(whole, node));
  outcome = play(directory.path("run.0002.jsonl"));
  CHECK(outcome.code == 124);
  CHECK(contains(outcome.err,
                 "began in an earlier file of the recording, and does not end in this "
                 "one: the recording is truncated, or has another file"));
  outcome = play(directory.path("run.0003.jsonl"));
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "began in an earlier file of the recording; `lockstep log cat"));
  outcome = play(directory.file("gap.jsonl", read_file(directory.path("run.0001.jsonl")) +
                                                 read_file(directory.path("run.0003.jsonl"))));
  CHECK(contains(outcome.err, "lacks ticks; `lockstep log cat"));
  // A kill: the file just ends.
  const std::string text = read_file(directory.path("run.0001.jsonl"));
  outcome = play(directory.file("cut.jsonl", text.substr(0, text.find("{\"tick\":5,"))));
  CHECK(outcome.code == 124);
  CHECK(contains(outcome.err, "' does not end in this one"));
  // After a cut, ticks happen again.
  const std::string again = "\"first_tick\":5," + text.substr(text.find("\"tree\""));
  const auto line = [&](int tick) { return text.find("{\"tick\":" + std::to_string(tick) + ","); };
  const std::string both = text.substr(0, line(6)) + "{\"lockstep_recording\":1," +
                           again.substr(0, again.find('\n') + 1) +
                           text.substr(line(5), text.find("{\"continued\"") - line(5));
  outcome = play(directory.file("both.jsonl", both));
  CHECK(outcome.code == 124);
  const auto rows = played(directory.path("again.jsonl"), "Main/r"), real = played(whole, node);
  CHECK(std::equal(real.begin(), real.begin() + 7, rows.begin()));
}

TEST_CASE("a recording that cannot be played ends the run before it begins, with the reason") {
  const TemporaryDirectory directory;
  const Outcome outcome =
      record(directory, "<Recorded file=\"/nowhere.jsonl\" node=\"Main/a\"/>", "x.jsonl");
  CHECK(outcome.code == 5);
  CHECK_THAT(outcome.err, Catch::Contains("'/nowhere.jsonl': cannot be read"));
}

TEST_CASE("a run does not record over the file that its tree plays") {
  const TemporaryDirectory directory;
  REQUIRE(record(directory, "<Advance name=\"a\" step=\"0.1\"/>", "real.jsonl").code == 0);
  const std::string real = directory.path("real.jsonl"), before = read_file(real);
  const std::string tree =
      directory.file("play.xml", tree_text("<Recorded file=\"" + real + "\" node=\"Main/a\"/>"));
  const Outcome outcome =
      run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", real});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "it is the same file as"));
  CHECK(read_file(real) == before);
}
