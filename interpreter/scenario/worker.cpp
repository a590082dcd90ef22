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
  if (part.stage == nullptr || !report.errors.empty()) return report;
  Diagnostics diagnostics;
  try {
    const Rehearsal rehearsal = rehearse(
        *part.scenario, part.file->sources, *part.stage, part.leaves,
        options_.changed_tree.empty() ? MissingLeaves::AreErrors : MissingLeaves::AreLeftOut,
        diagnostics);
    if (diagnostics.has_errors()) {
      diagnostics.sort();
      report.errors = diagnostics.all();
      return report;
    }
    play(part, rehearsal, report);
  } catch (const std::exception& error) {
    report.errors.push_back(
        {.location = part.file->sources.locate(part.scenario->place), .message = error.what()});
  }
  return report;
}

void ScenarioWorker::play(const PreparedScenario& part, const Rehearsal& rehearsal,
                          ScenarioReport& report) {
  if (part.scenario->is_verified) {
    report.surprises = verify_scenario(rehearsal, *part.stage, part.leaves, options_.stop_signal);
    report.was_stopped = options_.stop_signal && options_.stop_signal() != 0;
    return;
  }
  if (!initialize_plugins(part, rehearsal, report)) return;
  std::optional<RunCoverage> coverage;
  if (options_.covers) coverage.emplace(part.stage->tree());
  perform(part, rehearsal, report, coverage ? &*coverage : nullptr);
  if (!coverage) return;
  report.stage = part.stage;
  report.leaves = part.leaves;
  report.rate = rehearsal.rate;
  report.coverage = std::make_shared<NodeCoverage>(coverage->coverage());
}

void ScenarioWorker::perform(const PreparedScenario& part, const Rehearsal& rehearsal,
                             ScenarioReport& report, Observer* observer) {
  const Performer performer(rehearsal, players_for(part, rehearsal));
  for (std::uint64_t run = 0; run < part.scenario->runs; ++run) {
    PerformOptions options{.seed = part.scenario->seed + run,
                           .observer = observer,
                           .stop_signal = options_.stop_signal};
    Performance performance = performer.perform(options);
    ++report.runs;
    report.ticks += performance.end.ticks;
    if (performance.end.reason == StopReason::Signal) {
      report.was_stopped = true;
      return;
    }
    report.surprises = std::move(performance.surprises);
    options.observer = nullptr;
    if (!options_.updates) compare_to_golden(performer, options, report);
    if (report.surprises.empty()) continue;
    report.seed = options.seed;
    return record(part, performer, options, report);
  }
  if (options_.updates) update_golden(performer, report);
}

void ScenarioWorker::compare_to_golden(const Performer& performer, const PerformOptions& options,
                                       ScenarioReport& report) const {
  for (const Expectation& it : report.scenario->expectations) {
    if (it.kind == Expectation::Kind::SameAs)
      Golden{performer, it, options}.compare(report.surprises);
  }
}

// All runs are as expected otherwise: the first one is written, and the others are to be the same.
void ScenarioWorker::update_golden(const Performer& performer, ScenarioReport& report) const {
  PerformOptions options{.seed = report.scenario->seed, .stop_signal = options_.stop_signal};
  for (const Expectation& it : report.scenario->expectations) {
    if (it.kind == Expectation::Kind::SameAs)
      report.written += Golden{performer, it, options}.update(report.surprises) ? 1 : 0;
  }
  for (std::uint64_t run = 1; run < report.runs && report.surprises.empty(); ++run) {
    report.seed = ++options.seed;
    compare_to_golden(performer, options, report);
  }
}

void ScenarioWorker::record(const PreparedScenario& part, const Performer& performer,
                            PerformOptions options, ScenarioReport& report) const {
  if (options_.out.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(options_.out, error);
  options.record = (std::filesystem::path(options_.out) / (part.stem + ".jsonl")).string();
  const std::string problem = performer.perform(options).problem;
  if (problem.empty()) {
    report.recording = options.record;
  } else {
    report.surprises.back().more.push_back("there is no recording: " + problem);
  }
}

Players& ScenarioWorker::players_for(const PreparedScenario& part, const Rehearsal& rehearsal) {
  const bool is_usual = rehearsal.cast.real.empty() && rehearsal.models == nullptr;
  if (!may_reuse_ || !is_usual || &players_->stage() != part.stage.get()) {
    players_ = std::make_unique<Players>(part.stage, rehearsal.cast.real);
  }
  may_reuse_ = is_usual;
  return *players_;
}

bool ScenarioWorker::initialize_plugins(const PreparedScenario& part, const Rehearsal& rehearsal,
                                        ScenarioReport& report) {
  const bool has_control = std::ranges::any_of(part.stage->tree().leaves, [](const LeafNode& it) {
    return it.type->category == NodeCategory::Control ||
           it.type->category == NodeCategory::Decorator;
  });
  if (rehearsal.cast.real.empty() && !has_control) return true;
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  Diagnostics diagnostics;
  if (plugins_.initialize(diagnostics)) return true;
  report.errors = diagnostics.all();
  report.failure = LoadFailure::PluginRefused;
  return false;
}

}  // namespace lockstep::host
