// How far the children of a synchronized node are apart, as the paper measures it: one sample per
// tick of the node, taken before its children are ticked, completed children at 1. Numbers only:
// who feeds it, and from what, is synchronized_measure.h's matter.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/status.h"

namespace lockstep {

// The sum of |p_i - p_j| over all unordered pairs. `scratch` must be as long as `progress`; it
// holds them in order afterwards. O(n log n), no allocation.
double progress_distance(std::span<const double> progress, std::span<double> scratch);

// max p - min p; 0 for fewer than two.
double spread(std::span<const double> progress);

class ProgressDistance {
 public:
  explicit ProgressDistance(std::size_t children) : last_(children), scratch_(children) {}

  // As new, for the next run. No allocation.
  void reset();
  // The samples that follow belong to a new activation: no step leads to the first of them.
  void begin_activation() { has_last_ = false; }
  void sample(std::span<const double> progress);
  // The node has succeeded: each child's last step led to 1. That counts as a step, not a sample.
  void succeeded();
  // All of these, after a tick of the run: did it reach the node, what is its status since, and
  // what was the progress of its children.
  void after_tick(bool ticked, Status status, std::span<const double> progress) {
    if (ticked) {
      if (!running_) begin_activation();
      sample(progress);
      if (status == Status::Success) succeeded();
    }
    running_ = status == Status::Running;
  }

  std::uint64_t samples() const { return samples_; }
  double sum() const { return sum_; }
  double mean() const { return samples_ == 0 ? 0.0 : sum_ / static_cast<double>(samples_); }
  double largest_spread() const { return largest_spread_; }
  // The largest change of one child's progress from one sample of an activation to the next.
  double step_length() const { return step_length_; }

 private:
  void step(std::size_t child, double progress);

  std::vector<double> last_;
  std::vector<double> scratch_;
  bool has_last_ = false;
  bool running_ = false;
  std::uint64_t samples_ = 0;
  double sum_ = 0;
  double largest_spread_ = 0;
  double step_length_ = 0;
};

}  // namespace lockstep
