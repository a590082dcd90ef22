// The paper's predictability distance: how far from an expected time an action reaches a given
// progress. Also the numbers that a box plot is drawn from. Used by studies.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

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

 private:
  double target_;
  double time_ = 0;
  double gap_ = std::numeric_limits<double>::infinity();
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
