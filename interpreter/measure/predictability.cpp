#include "measure/predictability.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lockstep {
namespace {

constexpr double kEqualGap = 1e-9;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median_of(std::span<const double> sorted) {
  const std::size_t half = sorted.size() / 2;
  if (sorted.size() % 2 == 1) return sorted[half];
  return sorted[half - 1] + (sorted[half] - sorted[half - 1]) / 2;
}

}  // namespace

void NearestInstant::sample(double time, double progress) {
  least_ = std::min(least_, progress);
  most_ = std::max(most_, progress);
  const double gap = std::abs(progress - target_);
  if (!(gap < gap_ - kEqualGap)) return;
  gap_ = gap;
  time_ = time;
}

bool NearestInstant::reached() const {
  return least_ <= target_ + kEqualGap && most_ >= target_ - kEqualGap;
}

void Predictability::after_tick(std::uint64_t tick, double progress, bool ticked, Status status) {
  nearest_.sample(static_cast<double>(tick), progress);
  ticks_ = static_cast<double>(tick + 1);
  ticked_ |= ticked;
  succeeded_ = status == Status::Success;
}

NearestInstant Predictability::nearest() const {
  NearestInstant nearest = nearest_;
  if (succeeded_) nearest.sample(ticks_, 1);
  return nearest;
}

double Predictability::value() const {
  const NearestInstant it = nearest();
  return ticked_ && it.reached() ? it.time() - expected_ : kNone;
}

double Predictability::gap() const {
  if (!ticked_) return kNone;
  const double gap = nearest().gap();
  return gap <= kEqualGap ? 0 : gap;
}

double predictability_distance(std::span<const double> times, double expected) {
  return mean_of(times) - expected;
}

SampleSummary summarize(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::span<const double> sorted = values;
  const std::size_t half = std::max<std::size_t>(sorted.size() / 2, 1);
  return {.count = sorted.size(),
          .min = sorted.front(),
          .q1 = median_of(sorted.first(half)),
          .median = median_of(sorted),
          .q3 = median_of(sorted.last(half)),
          .max = sorted.back(),
          .mean = mean_of(sorted)};
}

}  // namespace lockstep
