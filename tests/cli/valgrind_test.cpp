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
