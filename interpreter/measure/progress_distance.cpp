#include "measure/progress_distance.h"

#include <algorithm>
#include <cmath>

namespace lockstep {

double progress_distance(std::span<const double> progress, std::span<double> scratch) {
  std::copy(progress.begin(), progress.end(), scratch.begin());
  const auto sorted = scratch.first(progress.size());
  std::sort(sorted.begin(), sorted.end());
  // The gap between two neighbors is part of the distance of each pair that lies around it.
  double sum = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    sum += (sorted[i] - sorted[i - 1]) * static_cast<double>(i * (sorted.size() - i));
  }
  return sum;
}

double spread(std::span<const double> progress) {
  if (progress.empty()) return 0;
  const auto [least, most] = std::minmax_element(progress.begin(), progress.end());
  return *most - *least;
}

void ProgressDistance::reset() {
  has_last_ = false;
  samples_ = 0;
  sum_ = largest_spread_ = step_length_ = 0;
}

void ProgressDistance::sample(std::span<const double> progress) {
  ++samples_;
  sum_ += progress_distance(progress, scratch_);
  largest_spread_ = std::max(largest_spread_, spread(progress));
  for (std::size_t child = 0; child < progress.size(); ++child) step(child, progress[child]);
  has_last_ = true;
}

void ProgressDistance::succeeded() {
  for (std::size_t child = 0; child < last_.size(); ++child) step(child, 1.0);
}

void ProgressDistance::step(std::size_t child, double progress) {
  if (has_last_) step_length_ = std::max(step_length_, std::abs(progress - last_[child]));
  last_[child] = progress;
}

}  // namespace lockstep
