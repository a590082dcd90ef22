// The paper's predictability distance: how far from an expected time an action reaches a given
// progress. Also the numbers that a box plot is drawn from. Used by studies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/status.h"

namespace lockstep {

// The first instant of a run at which the progress was nearest to a target. Gaps that differ by
// less than 1e-9 are equal, so the first of them counts. Samples come in the order of time.
class NearestInstant {
 public:
  explicit NearestInstant(double target) : target_(target) {}

  void sample(double time, double progress);

  bool empty() const { return gap_ == std::numeric_limits<double>::infinity(); }
  double time() const { return time_; }  // in the unit of the samples; 0 when empty
  double gap() const { return gap_; }    // |progress - target| at that time
  // Was the progress ever at the target, or on both sides of it?
  bool reached() const;

 private:
  double target_;
  double time_ = 0;
  double gap_ = std::numeric_limits<double>::infinity();
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -std::numeric_limits<double>::infinity();
};

// Of one node in one run, in ticks.
class Predictability {
 public:
  Predictability(double target, double expected) : target_(target), expected_(expected) {}

  // As new, for the next run.
  void reset() { *this = Predictability(target_, expected_); }
  // After each tick of the run, which count from 0: the progress before it, as the node's parent
  // used it, whether it reached the node, and the node's status since.
  void after_tick(std::uint64_t tick, double progress, bool ticked, Status status);

  // The instant minus the expected one; negative is early. What the node reached in the last tick
  // counts as if there were one more. NaN: its progress did not reach the target.
  double value() const;
  // How far from the target the progress was at that instant. NaN: no tick reached the node.
  double gap() const;

 private:
  NearestInstant nearest() const;

  double target_, expected_;
  NearestInstant nearest_{target_};
  double ticks_ = 0;
  bool ticked_ = false;
  bool succeeded_ = false;
};

// The mean over runs of the time of nearest progress, minus the expected time: negative is early.
// `times` must not be empty.
double predictability_distance(std::span<const double> times, double expected);

struct SampleSummary {
  std::size_t count = 0;
  double min = 0, q1 = 0, median = 0, q3 = 0, max = 0, mean = 0;
};

// The quartiles are the medians of the lower and the upper half; the median belongs to neither half
// when the count is odd. One value is its own quartiles; no values give zeros.
SampleSummary summarize(std::vector<double> values);

}  // namespace lockstep
