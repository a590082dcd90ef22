// What happened in the random runs, counted, so that a generator that no longer reaches something
// fails the test instead of passing it vacuously.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "support/scripted_run.h"

namespace lockstep::host::test {

class Coverage {
 public:
  // After each tick, before the run's events are cleared.
  void count(ScriptedRun& run);
  // Fails the Catch test for each thing that happened too rarely.
  void check() const;

 private:
  void count_event(const Event& event);
  void count_fault(std::string_view message);
  void at_least(long times, const std::string& what) const;

  std::map<std::string, long, std::less<>> seen_;
  std::vector<bool> paused_;  // leaves of the current run
};

// The same of the law of barriers and resources: cases that the reference interpreter met.
class GroupCoverage {
 public:
  // `refused`: why the checks of its document refuse a tree, or "".
  void count_tree(const std::string& refused);
  void count(const std::map<std::string, long>& cases);
  // Of so many trees as ./dev test has.
  void check() const;

 private:
  std::map<std::string, long> seen_;
  std::map<std::string, long> refusals_;  // by message
  long trees_ = 0;
};

}  // namespace lockstep::host::test
