// same-as="run.jsonl": the run as it was once, from the first tick to the last.
#pragma once

#include <cstdint>
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
};

// What `lockstep test --update` does with the recording of an expectation, for all runs of a
// scenario, which are as expected otherwise.
class GoldenUpdate {
 public:
  // `first` is of the first run; each of the others has the next seed. All must outlive this.
  GoldenUpdate(const ScenarioRunner& runner, const Expectation& expected,
               const ScenarioRunOptions& first, std::uint64_t runs)
      : runner_(runner), expected_(expected), first_(first), runs_(runs) {}

  // Replaces the recording if a run differs from it and all runs are the same. Returns whether it
  // did. If runs differ from each other, `surprises` and `seed` are of the first that does.
  bool run(std::vector<Surprise>& surprises, std::uint64_t& seed) const;

 private:
  bool is_that_of_all() const;
  bool is_same_in_all(const std::string& first, std::vector<Surprise>& surprises,
                      std::uint64_t& seed) const;

  const ScenarioRunner& runner_;
  const Expectation& expected_;
  const ScenarioRunOptions& first_;
  std::uint64_t runs_;
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
