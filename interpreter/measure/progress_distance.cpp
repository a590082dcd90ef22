#include "measure/progress_distance.h"

#include <algorithm>
#include <cmath>

namespace lockstep {

namespace {

// A study does this in every tick, and a few children are nearly sorted already.
void copy_sorted(std::span<const double> from, std::span<double> to) {
  constexpr std::size_t kFew = 16;
  if (from.size() > kFew) {
    std::copy(from.begin(), from.end(), to.begin());
    std::sort(to.begin(), to.end());
    return;
  }
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t at = i;
    for (; at > 0 && to[at - 1] > from[i]; --at) to[at] = to[at - 1];
    to[at] = from[i];
  }
}

}  // namespace

double progress_distance(std::span<const double> progress, std::span<double> scratch) {
  const auto sorted = scratch.first(progress.size());
  copy_sorted(progress, sorted);
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
  has_last_ = running_ = false;
  samples_ = 0;
  sum_ = largest_spread_ = step_length_ = 0;
}

void ProgressDistance::sample(std::span<const double> progress) {
  ++samples_;
  if (progress.empty()) return;
  sum_ += progress_distance(progress, scratch_);
  largest_spread_ = std::max(largest_spread_, scratch_.back() - scratch_.front());  // sorted now
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
