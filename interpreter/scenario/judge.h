// Compares a run with what was expected of it.
#pragma once

#include <string>
#include <vector>

#include "judge/measure/property_steps.h"
#include "scenario/scenario_runner.h"
#include "trace/observer.h"

namespace lockstep::host {

class RunMeasures;

class Judge final : public Observer {
 public:
  // All must outlive this.
  Judge(const BoundScenario& bound, const Tree& tree, std::vector<Property> properties);

  AskedOfRun asked() const override { return steps_.asked(); }
  void after_tick(const Moment& moment, const TickReport& report) override;
  void standing(const Moment& moment) override;

  // After the end; null: nothing is measured.
  std::vector<Surprise> verdict(const RunEnd& end, const RunMeasures* measures);

 private:
  void tell_violated(std::size_t property, const std::string& when, const Moment& moment);
  void judge_ending(const RunEnd& end);
  void judge_moments(const RunEnd& end);
  void judge_ending(const Expectation& expected, const RunEnd& end);
  void judge_node(const Expectation& expected, const RunEnd& end);
  void judge_limits(const RunMeasures& measures);
  std::vector<std::string> why(const RunEnd& end) const;

  const BoundScenario& bound_;
  const Tree& tree_;
  PropertyChecks checks_;
  PropertySteps steps_;
  std::uint64_t ticks_ = 0;
  std::vector<std::string> decided_;  // the path to what decided
  std::vector<std::string> running_;  // leaves, at the end
  std::vector<Surprise> surprises_;
};

// "success", "failure", "skipped", "fault", "running".
std::string_view result_text(const RunEnd& end);

}  // namespace lockstep::host
