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
  std::shared_ptr<const Stage> stage;  // null: its tree cannot be loaded
  const LeafFile* leaves;              // null: there is none
  std::vector<Diagnostic> errors;      // why it cannot be played
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
  void play(const PreparedScenario& part, const Rehearsal& rehearsal, ScenarioReport& report);
  void perform(const PreparedScenario& part, const Rehearsal& rehearsal, ScenarioReport& report,
               Observer* observer);
  void compare_to_golden(const Performer& performer, const PerformOptions& options,
                         ScenarioReport& report) const;
  void update_golden(const Performer& performer, ScenarioReport& report) const;
  void record(const PreparedScenario& part, const Performer& performer, PerformOptions options,
              ScenarioReport& report) const;
  // Those of before, if they fit.
  Players& players_for(const PreparedScenario& part, const Rehearsal& rehearsal);
  // Those whose nodes take part.
  bool initialize_plugins(const PreparedScenario& part, const Rehearsal& rehearsal,
                          ScenarioReport& report);

  const TestOptions& options_;
  PluginSet& plugins_;
  std::unique_ptr<Players> players_;
  bool may_reuse_ = false;
};

}  // namespace lockstep::host
