// Reports of scenarios, for people and for programs.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/clock.h"
#include "scenario/test_run.h"

namespace lockstep::host {

// "  ok    the arm slips  (3 ticks)", and of a failure all that is known of it. `width` is that of
// the names. Errors that are `told` are not told again.
std::string to_text(const ScenarioReport& report, std::size_t width, bool color,
                    std::span<const Diagnostic> told = {});

enum class ScenarioOutcome : unsigned char { Passed, Failed, Invalid, Stopped };
std::string_view to_string(ScenarioOutcome outcome);  // "passed"

struct TestCounts {
  std::size_t passed = 0, failed = 0, invalid = 0, stopped = 0;
  std::uint64_t runs = 0, ticks = 0;
  Nanoseconds took{0};

  void add(const ScenarioReport& report);
};
// "12 scenarios: 11 passed, 1 failed, 0.02 s".
std::string to_text(const TestCounts& counts);

// The content of a report, in one form for all programs.
struct ReportedScenario {
  std::string file, name, place;  // of its name: "a.test.xml:3:5"
  ScenarioOutcome outcome = ScenarioOutcome::Passed;
  std::uint64_t runs = 0, ticks = 0, seed = 0;
  struct Failure {
    std::string place, message;
    std::vector<std::string> more;
  };
  std::vector<Failure> failures = {};
  std::string recording = {}, replay = {}, again = {};  // a file, and lines for a shell
};
ReportedScenario reported(const ScenarioReport& report);

std::string to_json(std::span<const ReportedScenario> all, const TestCounts& counts);
// JUnit's XML: a suite for each file.
std::string to_junit(std::span<const ReportedScenario> all, const TestCounts& counts);

}  // namespace lockstep::host
