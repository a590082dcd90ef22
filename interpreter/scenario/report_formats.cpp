// Reports as JSON and as JUnit's XML, which continuous integration reads.
#include <fmt/format.h>

#include <map>

#include "base/json/json.h"
#include "describe/xsd.h"
#include "scenario/report_text.h"

namespace lockstep::host {
namespace {

std::string failure_text(const ReportedScenario& it) {
  std::string text;
  for (const auto& failure : it.failures) {
    text += fmt::format("{}: {}\n", failure.place, failure.message);
    for (const std::string& line : failure.more) text += fmt::format("  {}\n", line);
  }
  if (!it.replay.empty()) text += it.replay + '\n';
  return text;
}

// JUnit has failures, and errors of what could not be tested.
std::string test_case(const ReportedScenario& it) {
  std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}\" file=\"{}\"",
                                 xsd_escaped(it.file), xsd_escaped(it.name), xsd_escaped(it.file));
  if (it.outcome == ScenarioOutcome::Passed) return text + "/>\n";
  if (it.outcome == ScenarioOutcome::Stopped)
    return text + ">\n      <skipped message=\"stopped\"/>\n    </testcase>\n";
  const std::string_view tag = it.outcome == ScenarioOutcome::Failed ? "failure" : "error";
  const std::string first = it.failures.empty() ? std::string() : it.failures.front().message;
  return text + fmt::format(">\n      <{0} message=\"{1}\">{2}</{0}>\n    </testcase>\n", tag,
                            xsd_escaped(printable(first)), xsd_escaped(failure_text(it)));
}

}  // namespace

std::string to_json(std::span<const ReportedScenario> all, const TestCounts& counts) {
  Json scenarios = Json::array();
  for (const ReportedScenario& it : all) {
    Json scenario = Json::object();
    scenario["file"] = it.file;
    scenario["name"] = it.name;
    scenario["place"] = it.place;
    scenario["outcome"] = to_string(it.outcome);
    scenario["runs"] = it.runs;
    scenario["ticks"] = it.ticks;
    if (!it.failures.empty()) {
      Json failures = Json::array();
      for (const auto& failure : it.failures) {
        Json one = Json::object();
        one["place"] = failure.place;
        one["message"] = failure.message;
        one["more"] = Json(failure.more);
        failures.push_back(std::move(one));
      }
      scenario["failures"] = std::move(failures);
    }
    if (it.outcome == ScenarioOutcome::Failed) scenario["seed"] = it.seed;
    if (!it.recording.empty()) scenario["recording"] = it.recording;
    scenarios.push_back(std::move(scenario));
  }
  Json json = Json::object();
  json["passed"] = counts.passed;
  json["failed"] = counts.failed;
  json["invalid"] = counts.invalid;
  json["seconds"] = to_seconds(counts.took);
  json["scenarios"] = std::move(scenarios);
  return json.printable(2) + '\n';
}

std::string to_junit(std::span<const ReportedScenario> all, const TestCounts& counts) {
  struct Suite {
    std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
    std::string cases = {};
  };
  std::vector<std::pair<std::string, Suite>> suites;
  for (const ReportedScenario& it : all) {
    if (suites.empty() || suites.back().first != it.file) suites.emplace_back(it.file, Suite());
    Suite& suite = suites.back().second;
    ++suite.tests;
    if (it.outcome == ScenarioOutcome::Failed) ++suite.failures;
    if (it.outcome == ScenarioOutcome::Invalid) ++suite.errors;
    if (it.outcome == ScenarioOutcome::Stopped) ++suite.skipped;
    suite.cases += test_case(it);
  }
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"lockstep test\" tests=\"{}\" "
      "failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
      all.size(), counts.failed, counts.invalid, to_seconds(counts.took));
  for (const auto& [file, suite] : suites) {
    text += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n{}"
        "  </testsuite>\n",
        xsd_escaped(file), suite.tests, suite.failures, suite.errors, suite.skipped, suite.cases);
  }
  return text + "</testsuites>\n";
}

}  // namespace lockstep::host
