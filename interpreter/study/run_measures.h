// Measures the runs of one tree, one after the other: an observer that gives one number for each
// column that the tree has in a study.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/measure_spec.h"
#include "measure/predictability.h"
#include "measure/progress_distance.h"
#include "runtime/observer.h"
#include "study/plan.h"

namespace lockstep {

class RunMeasures final : public Observer {
 public:
  // A predictability of a node that is not in the tree is told in error(), and has no column.
  RunMeasures(const Tree& tree, std::span<const MeasureSpec> measures, double rate);

  const std::string& error() const { return error_; }
  const std::vector<StudyColumn>& columns() const { return columns_; }
  // Of the last run, in the order of columns(); NaN where it has no such number.
  std::span<const double> values() const { return values_; }

  void run_started(Ticker& ticker, const RunStart& start) override;
  void before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(Ticker& ticker, const TickReport& report) override;
  void run_ended(Ticker& ticker, const RunEnd& end) override;

 private:
  struct Distance {
    NodeIndex node;
    ProgressDistance measure;
    std::optional<std::size_t> sum, step_length;  // their columns
  };
  struct Instant {
    NodeIndex node;
    std::optional<NodeIndex> parent;  // if it is synchronized
    std::size_t child;                // the node's place among the parent's children
    Predictability measure;
    std::size_t column;  // the gap has the next
    double seen = 0;     // before the tick
  };
  std::size_t add_column(const MeasureSpec& measure, std::string node);
  void add_distances(const Tree& tree, const MeasureSpec& measure);
  void add_instant(const Tree& tree, const MeasureSpec& measure);

  double rate_;
  std::vector<Distance> distances_;
  std::vector<Instant> instants_;
  std::vector<std::size_t> durations_;  // their columns
  std::string error_;
  std::vector<StudyColumn> columns_;
  std::vector<double> values_;
};

}  // namespace lockstep
