// Measures the runs of one tree, one after the other: an observer that gives one number for each
// column that the tree has in a study.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "judge/measure/measuring.h"
#include "study/plan.h"
#include "trace/observer.h"

namespace lockstep::host {

class RunMeasures final : public Observer {
 public:
  // `measures` must outlive this. If a measure names something that the tree does not have, error()
  // reports it.
  RunMeasures(const Shape& shape, std::span<const MeasureSpec> measures, double rate);

  const std::string& error() const { return measuring_.error(); }
  const std::vector<StudyColumn>& columns() const { return columns_; }
  // The values of the last run, in the order of columns(); NaN where it has no such number.
  std::span<const double> values() const { return values_; }

  // What an observer does with a tick, for an owner that knows this one.
  void after_tick(const Moment& moment) {
    measuring_.after_tick(moment);
    last_ = moment.time;
  }

  AskedOfRun asked() const override { return measuring_.asked(); }
  void run_started(const Moment& moment, const RunStart& start) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

 private:
  Measuring measuring_;
  double rate_;
  bool real_time_ = false;
  Nanoseconds last_{0};  // tick of the run
  std::vector<StudyColumn> columns_;
  std::vector<double> values_;
};

}  // namespace lockstep::host
