// The events around the ticks of a scenario: entries that change, ticks that take long.
#pragma once

#include <vector>

#include "base/core/clock.h"
#include "run/run.h"
#include "scenario/bound_scenario.h"
#include "scenario/scenario_runner.h"
#include "trace/observer.h"

namespace lockstep::host {

// A virtual clock on which ticks may take time. With such ticks it counts as real, so that
// deadlines are missed as on a robot.
class ScenarioClock final : public Clock {
 public:
  explicit ScenarioClock(bool is_real) : is_real_(is_real) {}
  Nanoseconds now() override { return now_; }
  void sleep_until(Nanoseconds deadline) override { now_ = std::max(now_, deadline); }
  bool is_real() const override { return is_real_; }
  void pass(Nanoseconds time) { now_ += time; }

 private:
  const bool is_real_;
  Nanoseconds now_{0};
};

// Writes entries before ticks. The first of the observers.
class EntryWriter final : public Observer {
 public:
  EntryWriter(const BoundScenario& bound, Run& run)
      : changes_(bound.changes), is_done_(changes_.size()), run_(run) {}
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  // The values that an entry could not hold.
  const std::vector<Surprise>& verdict() const { return surprises_; }

 private:
  const std::vector<PreparedChange>& changes_;
  std::vector<bool> is_done_;
  Run& run_;
  std::vector<Surprise> surprises_;
};

// Answers for people, before ticks.
class Answerer final : public Observer {
 public:
  Answerer(const BoundScenario& bound, Run& run)
      : answers_(bound.answers), is_done_(answers_.size()), run_(run) {}
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  // The answers that came when nobody asked.
  const std::vector<Surprise>& verdict() const { return surprises_; }

 private:
  const std::vector<PreparedAnswer>& answers_;
  std::vector<bool> is_done_;
  Run& run_;
  std::vector<Surprise> surprises_;
};

// Lets time pass in ticks. The last of the observers.
class LateTicks final : public Observer {
 public:
  LateTicks(const Scenario& scenario, ScenarioClock& clock) : late_(scenario.late), clock_(clock) {}
  void after_tick(const Moment& moment, const TickReport& report) override;

 private:
  const std::vector<LateTick>& late_;
  ScenarioClock& clock_;
};

}  // namespace lockstep::host
