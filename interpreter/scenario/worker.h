// One of the threads that play scenarios.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scenario/test_run.h"

namespace lockstep::host {

struct PreparedScenario {
  const ScenarioFile* file;
  const Scenario* scenario;
  std::shared_ptr<const Fixture> fixture;  // null: its tree cannot be loaded
  const LeafFile* leaves;                  // null: there is none
  std::vector<Diagnostic> errors;          // why it cannot be played
  LoadFailure failure;
  std::string stem;  // of the names of its files
};

class ScenarioWorker {
 public:
  // Both must outlive this.
  ScenarioWorker(const TestOptions& options, PluginSet& plugins)
      : options_(options), plugins_(plugins) {}

  ScenarioReport play(const PreparedScenario& part);

 private:
  void play(const PreparedScenario& part, const BoundScenario& bound, ScenarioReport& report);
  void run(const PreparedScenario& part, const BoundScenario& bound, ScenarioReport& report,
           Observer* observer);
  void compare_to_golden(const ScenarioRunner& runner, const ScenarioRunOptions& options,
                         ScenarioReport& report) const;
  void update_golden(const ScenarioRunner& runner, ScenarioReport& report) const;
  void record(const PreparedScenario& part, const ScenarioRunner& runner,
              ScenarioRunOptions options, ScenarioReport& report) const;
  // Those of before, if they fit.
  StubLeaves& stubs_for(const PreparedScenario& part, const BoundScenario& bound);
  // Those whose nodes take part.
  bool initialize_plugins(const PreparedScenario& part, const BoundScenario& bound,
                          ScenarioReport& report);

  const TestOptions& options_;
  PluginSet& plugins_;
  std::unique_ptr<StubLeaves> stubs_;
  bool may_reuse_ = false;
};

}  // namespace lockstep::host
