#include "scenario/performance.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/wording.h"
#include "record/write/recorder.h"
#include "run/deadlines.h"
#include "run/loop.h"
#include "run/shape_of.h"
#include "scenario/input_watch.h"
#include "scenario/judge.h"
#include "scenario/stage_hands.h"
#include "study/run_measures.h"

namespace lockstep::host {
namespace {

std::vector<Property> properties_of(const Rehearsal& rehearsal) {
  std::vector<Property> properties;
  for (const PreparedProperty& it : rehearsal.properties) properties.push_back(it.property);
  return properties;
}

std::vector<MeasureSpec> measures_of(const Rehearsal& rehearsal) {
  std::vector<MeasureSpec> measures;
  for (const PreparedLimit& it : rehearsal.limits) {
    const bool is_there = std::ranges::find(measures, it.measure) != measures.end();
    if (!is_there) measures.push_back(it.measure);
  }
  return measures;
}

RecorderOptions recorder_options(const Rehearsal& rehearsal, const Stage& stage,
                                 const PerformOptions& options) {
  RunDescription run{
      .tree_file = rehearsal.scenario->tree, .rate_hz = rehearsal.rate, .seed = options.seed};
  run.arguments = values_of(stage.arguments());
  run.values = Stage::start_values(*rehearsal.scenario);
  return {.path = options.record, .run = std::move(run)};
}

}  // namespace

Performer::Performer(const Rehearsal& rehearsal, Players& players)
    : rehearsal_(rehearsal), players_(players) {
  players.leaves().set_scripts(rehearsal.cast.scripts);
  if (rehearsal.models != nullptr) players.leaves().set_models(players.tree(), *rehearsal.models);
}

Performance Performer::perform(const PerformOptions& options) const {
  const Scenario& scenario = *rehearsal_.scenario;
  const Tree& tree = players_.tree();
  const auto measures = measures_of(rehearsal_);
  InputWatch inputs(rehearsal_, tree);
  players_.leaves().set_watch(rehearsal_.inputs.empty() ? nullptr : &inputs);
  Judge judge(rehearsal_, tree, properties_of(rehearsal_));
  std::optional<RunMeasures> measured;
  if (!measures.empty()) measured.emplace(shape_of(tree), measures, rehearsal_.rate);
  std::optional<Recorder> recorder;
  if (!options.record.empty())
    recorder.emplace(shape_of(tree), recorder_options(rehearsal_, players_.stage(), options));
  Performance performance;
  if (recorder && !recorder->error().empty()) performance.problem = recorder->error();

  StageClock clock(!scenario.late.empty());
  Run run(tree,
          {.seed = options.seed, .period = deadline_of(1, rehearsal_.rate), .virtual_time = true});
  EntryWriter writer(rehearsal_, run);
  LateTicks late(scenario, clock);
  std::vector<Observer*> observers{&writer, &inputs, &judge};
  if (measured) observers.push_back(&*measured);
  if (recorder && performance.problem.empty()) observers.push_back(&*recorder);
  if (options.observer != nullptr) observers.push_back(options.observer);
  observers.push_back(&late);
  LoopOptions loop{.rate = rehearsal_.rate,
                   .max_ticks = scenario.max_ticks.value_or(kMostScenarioTicks),
                   .timeout = std::nullopt,
                   .stop_signal = options.stop_signal};
  performance.end = run_loop(run, clock, loop, observers);
  performance.surprises = judge.verdict(performance.end, measured ? &*measured : nullptr);
  std::ranges::move(inputs.verdict(), std::back_inserter(performance.surprises));
  std::ranges::stable_sort(performance.surprises, {},
                           [](const Surprise& it) { return it.place.byte; });
  if (recorder && !recorder->error().empty()) performance.problem = recorder->error();
  return performance;
}

}  // namespace lockstep::host
