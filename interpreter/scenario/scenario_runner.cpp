#include "scenario/scenario_runner.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/wording.h"
#include "record/write/recorder.h"
#include "run/loop.h"
#include "run/shape_of.h"
#include "scenario/input_watch.h"
#include "scenario/judge.h"
#include "scenario/timed_events.h"
#include "study/run_measures.h"

namespace lockstep::host {
namespace {

std::vector<Property> properties_of(const BoundScenario& bound) {
  std::vector<Property> properties;
  for (const PreparedProperty& it : bound.properties) properties.push_back(it.property);
  return properties;
}

std::vector<MeasureSpec> measures_of(const BoundScenario& bound) {
  std::vector<MeasureSpec> measures;
  for (const PreparedLimit& it : bound.limits) {
    const bool is_there = std::ranges::find(measures, it.measure) != measures.end();
    if (!is_there) measures.push_back(it.measure);
  }
  return measures;
}

RecorderOptions recorder_options(const BoundScenario& bound, const Fixture& fixture,
                                 const ScenarioRunOptions& options) {
  RunDescription run{
      .tree_file = bound.scenario->tree, .rate_hz = bound.rate, .seed = options.seed};
  run.arguments = values_of(fixture.arguments());
  run.values = Fixture::start_values(*bound.scenario);
  run.exactly_once = bound.scenario->exactly_once;
  return {.path = options.record, .run = std::move(run)};
}

}  // namespace

ScenarioRunner::ScenarioRunner(const BoundScenario& bound, StubLeaves& stubs)
    : bound_(bound), stubs_(stubs) {
  stubs.leaves().set_scripts(bound.bindings.scripts);
  if (bound.models != nullptr) stubs.leaves().set_models(stubs.tree(), *bound.models);
}

ScenarioResult ScenarioRunner::run(const ScenarioRunOptions& options) const {
  const Scenario& scenario = *bound_.scenario;
  const Tree& tree = stubs_.tree();
  const auto measures = measures_of(bound_);
  InputWatch inputs(bound_, tree);
  stubs_.leaves().set_watch(bound_.inputs.empty() ? nullptr : &inputs);
  Judge judge(bound_, tree, properties_of(bound_));
  std::optional<RunMeasures> measured;
  if (!measures.empty()) measured.emplace(shape_of(tree), measures, bound_.rate);
  std::optional<Recorder> recorder;
  if (!options.record.empty())
    recorder.emplace(shape_of(tree), recorder_options(bound_, stubs_.fixture(), options));
  ScenarioResult result;
  if (recorder && !recorder->error().empty()) result.problem = recorder->error();

  ScenarioClock clock(!scenario.late.empty());
  Run run(tree, {.seed = options.seed,
                 .rate = bound_.rate,
                 .exactly_once = scenario.exactly_once,
                 .virtual_time = true});
  EntryWriter writer(bound_, run);
  Answerer answerer(bound_, run);
  LateTicks late(scenario, clock);
  std::vector<Observer*> observers{&writer, &answerer, &inputs, &judge};
  if (measured) observers.push_back(&*measured);
  if (recorder && result.problem.empty()) observers.push_back(&*recorder);
  if (options.observer != nullptr) observers.push_back(options.observer);
  observers.push_back(&late);
  LoopOptions loop{.rate = bound_.rate,
                   .max_ticks = scenario.max_ticks.value_or(kMostScenarioTicks),
                   .timeout = std::nullopt,
                   .stop_signal = options.stop_signal};
  result.end = run_loop(run, clock, loop, observers);
  result.surprises = judge.verdict(result.end, measured ? &*measured : nullptr);
  std::ranges::move(inputs.verdict(), std::back_inserter(result.surprises));
  std::ranges::copy(writer.verdict(), std::back_inserter(result.surprises));
  std::ranges::copy(answerer.verdict(), std::back_inserter(result.surprises));
  std::ranges::stable_sort(result.surprises, {}, [](const Surprise& it) { return it.place.byte; });
  if (recorder && !recorder->error().empty()) result.problem = recorder->error();
  return result;
}

}  // namespace lockstep::host
