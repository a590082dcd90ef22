// The properties of a run that a program ticks: checked until its root has a result, a fault or a
// loop ends it, or it is restarted. Only within embedding/.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/problem.h"
#include "engine/tree.h"
#include "judge/measure/property_steps.h"
#include "trace/observer.h"

namespace lockstep::host::embedding {

class RunProperties final : public Observer {
 public:
  // The tree must outlive this.
  explicit RunProperties(const Tree& tree) : tree_(tree) { begin_again(); }

  // Before the first tick. What is wrong with the text, or nothing.
  std::optional<Problem> add(std::string_view text);
  void add(std::span<const Property> properties);
  bool empty() const { return properties_.empty(); }
  // The run is as new.
  void begin_again();
  // Before the first tick: continues the properties of a run that was cut.
  void go_on(const KeptProperties& kept);
  // The names of those that were not checked before the cut, in the order of the properties.
  std::span<const std::string> fresh() const { return fresh_; }
  PropertyChecks& checks() { return *checks_; }

  // A text for each property that is violated, in the order in which that was found.
  std::span<const std::string> violations() const { return violations_; }

  AskedOfRun asked() const override { return steps_ ? steps_->asked() : AskedOfRun(); }
  void after_tick(const Moment& moment, const TickReport& report) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

 private:
  void make();
  void end(RunIsOver how, std::uint64_t ticks);

  const Tree& tree_;
  std::vector<Property> properties_;
  std::optional<PropertyChecks> checks_;
  std::optional<PropertySteps> steps_;
  std::optional<KeptProperties> kept_;  // before a cut; nothing: there was none
  std::vector<std::string> fresh_;
  bool is_over_ = false;
  std::vector<std::string> violations_;
};

}  // namespace lockstep::host::embedding
