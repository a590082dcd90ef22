#include "scenario/worker.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <mutex>

#include "scenario/golden.h"
#include "scenario/verified_scenario.h"

namespace lockstep::host {

ScenarioReport ScenarioWorker::play(const PreparedScenario& part) {
  ScenarioReport report{.file = part.file, .scenario = part.scenario};
  report.errors = part.errors;
  report.failure = part.failure;
  if (part.fixture == nullptr || !report.errors.empty()) return report;
  Diagnostics diagnostics;
  try {
    const BoundScenario bound = bind_scenario(
        *part.scenario, part.file->sources, *part.fixture, part.leaves,
        options_.changed_tree.empty() ? MissingLeaves::AreErrors : MissingLeaves::AreLeftOut,
        diagnostics);
    if (diagnostics.has_errors()) {
      diagnostics.sort();
      report.errors = diagnostics.all();
      return report;
    }
    play(part, bound, report);
  } catch (const std::exception& error) {
    report.errors.push_back(
        {.location = part.file->sources.locate(part.scenario->place), .message = error.what()});
  }
  return report;
}

void ScenarioWorker::play(const PreparedScenario& part, const BoundScenario& bound,
                          ScenarioReport& report) {
  if (part.scenario->is_verified) {
    report.surprises = verify_scenario(bound, *part.fixture, part.leaves, options_.stop_signal);
    report.was_stopped = options_.stop_signal && options_.stop_signal() != 0;
    return;
  }
  if (!initialize_plugins(part, bound, report)) return;
  std::optional<RunCoverage> coverage;
  if (options_.covers) coverage.emplace(part.fixture->tree());
  run(part, bound, report, coverage ? &*coverage : nullptr);
  if (!coverage) return;
  report.fixture = part.fixture;
  report.leaves = part.leaves;
  report.rate = bound.rate;
  report.coverage = std::make_shared<NodeCoverage>(coverage->coverage());
}

void ScenarioWorker::run(const PreparedScenario& part, const BoundScenario& bound,
                         ScenarioReport& report, Observer* observer) {
  const ScenarioRunner runner(bound, stubs_for(part, bound));
  for (std::uint64_t run = 0; run < part.scenario->runs; ++run) {
    ScenarioRunOptions options{.seed = part.scenario->seed + run,
                               .observer = observer,
                               .stop_signal = options_.stop_signal};
    ScenarioResult result = runner.run(options);
    ++report.runs;
    report.ticks += result.end.ticks;
    if (result.end.reason == StopReason::Signal) {
      report.was_stopped = true;
      return;
    }
    report.surprises = std::move(result.surprises);
    options.observer = nullptr;
    if (!options_.updates) compare_to_golden(runner, options, report);
    if (report.surprises.empty()) continue;
    report.seed = options.seed;
    return record(part, runner, options, report);
  }
  if (options_.updates) update_golden(runner, report);
}

void ScenarioWorker::compare_to_golden(const ScenarioRunner& runner,
                                       const ScenarioRunOptions& options,
                                       ScenarioReport& report) const {
  for (const Expectation& it : report.scenario->expectations) {
    if (it.kind == Expectation::Kind::SameAs) Golden{runner, it, options}.compare(report.surprises);
  }
}

// All runs are as expected otherwise.
void ScenarioWorker::update_golden(const ScenarioRunner& runner, ScenarioReport& report) const {
  const ScenarioRunOptions first{.seed = report.scenario->seed,
                                 .stop_signal = options_.stop_signal};
  for (const Expectation& it : report.scenario->expectations) {
    if (it.kind != Expectation::Kind::SameAs || !report.surprises.empty()) continue;
    const GoldenUpdate update(runner, it, first, report.runs);
    if (update.run(report.surprises, report.seed)) ++report.written;
  }
}

void ScenarioWorker::record(const PreparedScenario& part, const ScenarioRunner& runner,
                            ScenarioRunOptions options, ScenarioReport& report) const {
  if (options_.out.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(options_.out, error);
  options.record = (std::filesystem::path(options_.out) / (part.stem + ".jsonl")).string();
  const std::string problem = runner.run(options).problem;
  if (problem.empty()) {
    report.recording = options.record;
  } else {
    report.surprises.back().more.push_back("there is no recording: " + problem);
  }
}

StubLeaves& ScenarioWorker::stubs_for(const PreparedScenario& part, const BoundScenario& bound) {
  const bool is_usual = bound.bindings.real.empty() && bound.models == nullptr;
  if (!may_reuse_ || !is_usual || &stubs_->fixture() != part.fixture.get()) {
    stubs_ = std::make_unique<StubLeaves>(part.fixture, bound.bindings.real);
  }
  may_reuse_ = is_usual;
  return *stubs_;
}

bool ScenarioWorker::initialize_plugins(const PreparedScenario& part, const BoundScenario& bound,
                                        ScenarioReport& report) {
  const bool has_control = std::ranges::any_of(part.fixture->tree().leaves, [](const LeafNode& it) {
    return it.type->category == NodeCategory::Control ||
           it.type->category == NodeCategory::Decorator;
  });
  if (bound.bindings.real.empty() && !has_control) return true;
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  Diagnostics diagnostics;
  if (plugins_.initialize(diagnostics)) return true;
  report.errors = diagnostics.all();
  report.failure = LoadFailure::PluginRefused;
  return false;
}

}  // namespace lockstep::host
