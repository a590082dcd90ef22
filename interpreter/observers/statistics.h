// Measures a run for its summary: tick periods, and every synchronized node. Allocates nothing
// while the run ticks. Prints nothing itself.
#pragma once

#include <vector>

#include "core/histogram.h"
#include "measure/synchronized_measure.h"
#include "observers/summary.h"
#include "runtime/observer.h"

namespace lockstep {

class Statistics final : public Observer {
 public:
  explicit Statistics(const Tree& tree);

  void run_started(Ticker& ticker, const RunStart& start) override;
  void after_tick(Ticker& ticker, const TickReport& report) override;
  void run_ended(Ticker& ticker, const RunEnd& end) override;

  // Complete once the run has ended.
  Summary summary() const;

 private:
  struct Measured {
    SynchronizedProbe probe;
    SynchronizedMeasure measure;
  };
  SynchronizedSummary summary_of(const Measured& measured) const;

  const Tree& tree_;
  std::vector<Measured> nodes_;
  Histogram periods_;
  bool real_time_ = false;
  Nanoseconds last_start_{0};
  std::string fault_;
  RunEnd end_;
};

// "Door/pull/arm: threw …", or "" when there is no fault.
std::string fault_text(const Ticker& ticker);

}  // namespace lockstep
