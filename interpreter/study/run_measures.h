// Measures the runs of one tree, one after the other: an observer that gives one number for each
// column that the tree has in a study.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "judge/measure/measuring.h"
#include "study/plan.h"
#include "trace/live_moments.h"
#include "trace/observer.h"

namespace lockstep::host {

class RunMeasures final : public Observer {
 public:
  // `measures` must outlive this. If a measure names something that the tree does not have, error()
  // reports it.
  RunMeasures(const Tree& tree, std::span<const MeasureSpec> measures, double rate);

  const std::string& error() const { return measuring_.error(); }
  const std::vector<StudyColumn>& columns() const { return columns_; }
  // The values of the last run, in the order of columns(); NaN where it has no such number.
  std::span<const double> values() const { return values_; }

  // What an observer does with a tick, for an owner that knows this one.
  void before_tick(Ticker& ticker) { moments_.before_tick(ticker); }
  void after_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) {
    measuring_.after_tick(moments_.after_tick(ticker, tick, time));
    last_ = time;
  }

  void run_started(Ticker& ticker, const RunStart& start) override;
  void before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(Ticker& ticker, const TickReport& report) override;
  void run_ended(Ticker& ticker, const RunEnd& end) override;

 private:
  Measuring measuring_;
  LiveMoments moments_;
  double rate_;
  Nanoseconds last_{0};  // tick of the run
  std::vector<StudyColumn> columns_;
  std::vector<double> values_;
};

}  // namespace lockstep::host
