// A scenario played: what came of it, against what was expected.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenario/bound_scenario.h"
#include "trace/observer.h"

namespace lockstep::host {

// Something was not as expected.
struct Surprise {
  Place place = {};                    // of what was expected
  std::string message;                 // "expected success, came failure"
  std::vector<std::string> more = {};  // lines: where, and in which tick
};

struct ScenarioResult {
  RunEnd end;
  std::vector<Surprise> surprises;
  std::string problem = {};  // why the recording was not written
};

struct ScenarioRunOptions {
  std::uint64_t seed = 0;
  std::string record = {};       // a file; "": none
  Observer* observer = nullptr;  // of each tick, too
  std::function<int()> stop_signal = {};
};

class ScenarioRunner {
 public:
  // Both must outlive this. The stubs belong to the scenario from now on; if it has
  // models, for ever.
  ScenarioRunner(const BoundScenario& bound, StubLeaves& stubs);

  // Plays it once.
  ScenarioResult run(const ScenarioRunOptions& options) const;

 private:
  const BoundScenario& bound_;
  StubLeaves& stubs_;
};

}  // namespace lockstep::host
