// Checks properties while a tree runs: tells each violation once, in the tick that shows it, and
// keeps the verdicts for the summary.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "judge/measure/property_steps.h"
#include "judge/summary/summary.h"
#include "trace/observer.h"

namespace lockstep::host {

class PropertyObserver final : public Observer {
 public:
  // On the tick thread, in the tick that shows it or at the end of the run: the property, and when
  // it was violated.
  using Tell = std::function<void(const Property& property, const std::string& when)>;
  PropertyObserver(std::vector<Property> properties, Tell tell);

  AskedOfRun asked() const override { return steps_.asked(); }
  void after_tick(const Moment& moment, const TickReport& report) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

  bool is_violated() const { return checks_.any(PropertyVerdict::Violated); }
  void add_to(Summary& summary) const;
  PropertyChecks& checks() { return checks_; }

 private:
  PropertyChecks checks_;
  PropertySteps steps_;
  Tell tell_;
};

}  // namespace lockstep::host
