// The leaf Recorded of the plugin motion: what one run has recorded, another one plays.
#include <catch2/catch.hpp>

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
