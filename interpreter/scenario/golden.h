// same-as="run.jsonl": the run as it was once, from the first tick to the last.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/core/diagnostics.h"
#include "scenario/scenario_runner.h"

namespace lockstep::host {

struct Golden {
  const ScenarioRunner& runner;
  const Expectation& expected;
  const ScenarioRunOptions& options;  // of the run

  // Adds what differs.
  void compare(std::vector<Surprise>& surprises) const;
  // Writes it again if it differs. True: it was written.
  bool update(std::vector<Surprise>& surprises) const;
};

// Which recordings `lockstep test --update` may write: those below the folder of the scenario file,
// each that of one scenario, and never over a file that is no recording.
class GoldenFiles {
 public:
  explicit GoldenFiles(const std::vector<const ScenarioFile*>& files);
  // Adds why a recording of this scenario is not written.
  void check(const ScenarioFile& file, const Scenario& scenario,
             std::vector<Diagnostic>& errors) const;

 private:
  std::map<std::string, std::set<const Scenario*>> users_;  // by its path without links
};

}  // namespace lockstep::host
