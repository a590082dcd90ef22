// Nodes written for BehaviorTree.CPP, compiled unchanged: what they print with lockstep is what
// they print with that library (the .txt beside each).
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

#include "cli/program.h"

using namespace lockstep::test;

namespace {

constexpr const char* kSources = LOCKSTEP_SOURCE_DIR "/tests/btcpp/leaves/";

Outcome run_leaves(const std::string& name, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run",      kSources + name + ".xml",
                                     "--plugin", LOCKSTEP_BTCPP_PLUGINS "/" + name + ".so",
                                     "--clock",  "virtual",
                                     "--view",   "none"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return lockstep::test::lockstep(arguments);
}

}  // namespace

TEST_CASE(
    "leaves for BehaviorTree.CPP: they print with lockstep what they print with the library") {
  int seen = 0;
  for (const auto& file : std::filesystem::directory_iterator(kSources)) {
    if (file.path().extension() != ".txt") continue;
    ++seen;
    const std::string name = file.path().stem();
    const Outcome outcome = run_leaves(name);
    // What leaves print goes to stderr; the result is the first word on stdout.
    auto printed = lines(outcome.err);
    printed.push_back(outcome.out.substr(0, outcome.out.find(' ')));
    INFO(name);
    CHECK(printed == lines(read_file(file.path())));
  }
  CHECK(seen >= 1);
}
