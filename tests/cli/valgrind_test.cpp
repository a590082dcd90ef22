// valgrind runs lockstep, so that authors can look for leaks in their leaves.
#include <catch2/catch.hpp>
#include <filesystem>

#include "support/program.h"

using namespace lockstep::host::test;

TEST_CASE("valgrind finds no error and no leak in a run: what it finds is the plugin's") {
  const std::string valgrind = "/usr/bin/valgrind";
  const bool is_sanitized = std::string(LOCKSTEP_PRELOAD) != "";
  if (is_sanitized || !std::filesystem::exists(valgrind)) return;
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", tree_text("<ParallelAbsolute barriers=\"0.5\"><Advance step=\"0.1\"/><Advance "
                            "name=\"b\" step=\"0.3\"/></ParallelAbsolute>"));
  const Outcome outcome =
      run({.arguments = {"-q", "--leak-check=full", "--show-leak-kinds=definite",
                         "--errors-for-leak-kinds=definite", "--error-exitcode=9",
                         LOCKSTEP_BINARY_DIR "/lockstep", "run", tree, "--clock", "virtual",
                         "--record", directory.path("run.jsonl")},
           .program = valgrind});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "success after 10 ticks"));
}

TEST_CASE("under valgrind, which has no pidfd_open, plugins of other processes start and end") {
  const std::string valgrind = "/usr/bin/valgrind";
  const bool is_sanitized = std::string(LOCKSTEP_PRELOAD) != "";
  if (is_sanitized || !std::filesystem::exists(valgrind)) return;
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", R"(<root lockstep="1"><plugin name="motion" isolate="true"/>)"
                  R"(<plugin name="conditions" program="conditions.py"/><BehaviorTree ID="Main">)"
                  R"(<Sequence><IsUp/><Advance step="0.1"/></Sequence></BehaviorTree></root>)");
  const Outcome outcome =
      run({.arguments = {"-q", LOCKSTEP_BINARY_DIR "/lockstep", "run", tree, "--plugin-path",
                         LOCKSTEP_SOURCE_DIR "/tests/programs", "--clock", "virtual"},
           .program = valgrind});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "success after 10 ticks"));
  const Outcome checked = run({.arguments = {"-q", LOCKSTEP_BINARY_DIR "/lockstep", "plugin",
                                             "check", LOCKSTEP_BINARY_DIR "/plugins/motion.so"},
                               .program = valgrind});
  CHECK(checked.code == 0);
  CHECK(contains(checked.out, "motion.so: ok"));
}
