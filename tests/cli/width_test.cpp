// What commands print for people fits into the terminal.
#include <catch2/catch.hpp>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

std::size_t longest_line(const std::string& text) {
  std::size_t longest = 0;
  for (std::string line : lines(text)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    longest = std::max(longest, line.size());
  }
  return longest;
}

// What the command prints where a terminal is so wide.
std::string on_terminal(int columns, const std::string& command) {
  Process process({.arguments = {"-c", "stty cols " + std::to_string(columns) + " && " + command},
                   .environment = {{"NO_COLOR", "1"}},
                   .program = "/bin/sh"},
                  Process::Output::Terminal);
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 0);
  return outcome.out;
}

struct Recorded {
  Recorded() {
    file = directory.file(
        "tree.xml",
        tree_text("<ParallelAbsolute name=\"a_rather_long_name\" barriers=\"0.33333;0.66666\">"
                  "<Advance name=\"arm\" step=\"0.01\" noise=\"0.005\"/><Advance name=\"base\" "
                  "step=\"0.03\" noise=\"0.005\"/></ParallelAbsolute>"));
    run = quoted + "run " + file + " --clock virtual --view none --record " + recording;
    study = quoted + "study " + file + " --runs 20 --grid seed=1,2 --no-plots --measure spread " +
            "--measure duration --out " + directory.path("out");
  }

  TemporaryDirectory directory;
  const std::string quoted = "'" LOCKSTEP_BINARY_DIR "/lockstep' ";
  const std::string recording = directory.path("run.jsonl");
  std::string file, run, study;
};

}  // namespace

TEST_CASE("summaries and tables fit into 80 columns, and into a narrower terminal") {
  const Recorded it;
  const std::string commands[] = {
      it.run, it.quoted + "log info " + it.recording, it.quoted + "log measure " + it.recording,
      it.study + " 2>/dev/null",
      it.quoted + "study compare " + it.directory.path("out") + " --cells 0 1"};
  for (const std::string& command : commands) {
    const std::string clear = "rm -rf " + it.directory.path("out2") + "; ";
    const std::string wide = on_terminal(80, clear + command);
    INFO(wide);
    CHECK(longest_line(wide) <= 80);
    CHECK(longest_line(wide) > 20);
  }
  for (const std::string& command : {commands[0], commands[4]}) {
    const std::string narrow = on_terminal(52, command);
    INFO(narrow);
    CHECK(longest_line(narrow) <= 52);
  }
}

TEST_CASE("where there is no terminal, no line of a table is divided") {
  const Recorded it;
  on_terminal(80, it.study + " 2>/dev/null");
  const Outcome outcome =
      run_lockstep({"study", "compare", it.directory.path("out"), "--cells", "0", "1"});
  const auto all = lines(outcome.out);
  REQUIRE(all.size() == 7);
  CHECK(longest_line(outcome.out) > 80);
}
