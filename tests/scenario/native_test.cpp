// Scenarios as tests of CTest and of pytest.
#include <catch2/catch.hpp>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// Two scenarios, of which the second is not as expected.
void write_scenarios(const TemporaryDirectory& directory) {
  static_cast<void>(directory.file("t.xml", tree_text("<Advance name=\"a\" step=\"0.5\"/>")));
  static_cast<void>(directory.file("t.test.xml", R"(<scenarios lockstep="1" tree="t.xml">
    <scenario name="it arrives; [really]"><expect result="success"/></scenario>
    <scenario name="it fails"><expect result="failure"/></scenario></scenarios>)"));
}

}  // namespace

TEST_CASE("each scenario is a test of CTest") {
  const TemporaryDirectory directory;
  write_scenarios(directory);
  static_cast<void>(directory.file("CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.20)
project(trees NONE)
include()" LOCKSTEP_SOURCE_DIR R"(/plugins/sdk/lockstep_add_tree_tests.cmake)
enable_testing()
lockstep_add_tree_tests(.)
)"));
  const std::string build = directory.path("build");
  const Outcome made = run({.arguments = {"-S", directory.path("."), "-B", build,
                                          "-DLOCKSTEP_PROGRAM=" LOCKSTEP_BINARY_DIR "/lockstep"},
                            .program = "cmake"});
  INFO(made.out << made.err);
  REQUIRE(made.code == 0);
  const Outcome it = run({.arguments = {"--test-dir", build}, .program = "ctest"});
  INFO(it.out);
  CHECK(contains(it.out, "t.test.xml: it arrives; [really] "));
  CHECK(contains(it.out, "50% tests passed, 1 tests failed out of 2"));
  CHECK(std::filesystem::exists(build + "/failed-scenarios/t.it-fails.jsonl"));
}

TEST_CASE("each scenario is a test of pytest") {
  const auto python = [](std::vector<std::string> words) {
    return run({.arguments = std::move(words),
                .environment = {{"LOCKSTEP", LOCKSTEP_BINARY_DIR "/lockstep"},
                                {"PYTHONPATH", LOCKSTEP_SOURCE_DIR "/plugins/sdk/python"},
                                {"PYTHONDONTWRITEBYTECODE", "1"}},
                .program = "/usr/bin/python3"});
  };
  if (python({"-c", "import pytest"}).code != 0) return;  // Debian python3-pytest
  const TemporaryDirectory directory;
  write_scenarios(directory);
  const Outcome it =
      python({"-m", "pytest", "-p", "lockstep.pytest_plugin", "-p", "no:cacheprovider", "-v",
              "--lockstep-option=--out=" + directory.path("failed"), directory.path(".")});
  INFO(it.out << it.err);
  CHECK(it.code == 1);
  CHECK(contains(it.out, "1 failed, 1 passed"));
  CHECK(contains(it.out, "t.test.xml:3:47: expected failure, came success"));
  CHECK(contains(it.out, "lockstep replay "));
}
