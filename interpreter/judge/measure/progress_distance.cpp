#include "judge/measure/progress_distance.h"

#include <algorithm>
#include <cmath>

#include "base/core/value.h"

namespace lockstep::host {

namespace {

// Without what is left out. A general sort takes most of the time for the few children that a
// parallel has.
std::span<double> copy_sorted(std::span<const double> values, std::span<double> sorted) {
  constexpr std::size_t kFew = 16;
  std::size_t count = 0;
  if (values.size() > kFew) {
    for (const double value : values) {
      if (!std::isnan(value)) sorted[count++] = value;
    }
    std::ranges::sort(sorted.first(count));
    return sorted.first(count);
  }
  for (const double value : values) {
    if (std::isnan(value)) continue;
    std::size_t place = count++;
    for (; place > 0 && sorted[place - 1] > value; --place) sorted[place] = sorted[place - 1];
    sorted[place] = value;
  }
  return sorted.first(count);
}

}  // namespace

double progress_distance(std::span<const double> progress, std::span<double> scratch) {
  if (progress.size() == 2) {
    const bool is_alone = std::isnan(progress[0]) || std::isnan(progress[1]);
    return is_alone ? 0 : std::abs(progress[0] - progress[1]);
  }
  const auto sorted = copy_sorted(progress, scratch);
  // The gap between two neighbors is part of the distance of each pair that lies around it.
  double sum = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    sum += (sorted[i] - sorted[i - 1]) * static_cast<double>(i * (sorted.size() - i));
  }
  return sum;
}

void ProgressDistance::after_tick(const TickView& view) {
  const SynchronizedTick& tick = view.parallels[place_];
  if (!tick.ticked) return;
  const std::uint64_t sample = seen_++;
  if (sample < range_.first || sample > range_.last) return;
  ++samples_;
  sum_ += progress_distance(tick.progress, scratch_);
}

namespace {

class ProgressDistanceMean final : public ProgressDistance {
 public:
  using ProgressDistance::ProgressDistance;
  double value(const EndView&) const override { return samples() == 0 ? kNoValue : mean(); }
};

class ProgressDistanceSeconds final : public ProgressDistance {
 public:
  using ProgressDistance::ProgressDistance;
  double value(const EndView& end) const override {
    return samples() == 0 || end.rate == 0 ? kNoValue : sum() / end.rate;
  }
};

// "[K1:K2]", of which the brackets are left out.
bool take_samples(std::string_view text, MeasureSpec& spec) {
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) return false;
  const auto first = parse_int(text.substr(0, colon)), last = parse_int(text.substr(colon + 1));
  if (!first || !last || *first < 0 || *first > *last) return false;
  spec.numbers = {static_cast<double>(*first), static_cast<double>(*last)};
  spec.argument = "[" + std::to_string(*first) + ":" + std::to_string(*last) + "]";
  return true;
}

// "[K1:K2]:PATH", either or nothing.
std::string parse_samples(std::string_view argument, MeasureSpec& spec) {
  const auto end = argument.starts_with('[') ? argument.find(']') : std::string_view::npos;
  if (end != std::string_view::npos && take_samples(argument.substr(1, end - 1), spec)) {
    argument.remove_prefix(end + 1);
  }
  if (argument.empty()) return {};
  if (argument.size() > 1 && argument.front() == ':') {
    spec.argument.append(argument);
    spec.name = argument.substr(1);
    return {};
  }
  return "expected 'progress-distance[K1:K2]', with whole numbers from 0 and K1 no more than K2, "
         "and then ':PATH' to measure one parallel";
}

std::unique_ptr<Accumulator> make_distance(const MeasureSpec& spec, const MeasureTarget& target) {
  if (spec.numbers.empty()) return std::make_unique<ProgressDistance>(target);
  const ProgressDistance::Samples samples{static_cast<std::uint64_t>(spec.numbers[0]),
                                          static_cast<std::uint64_t>(spec.numbers[1])};
  return std::make_unique<ProgressDistance>(target, samples);
}

}  // namespace

extern const Measure kProgressDistance{
    .name = "progress-distance",
    .argument = "[[K1:K2]][:PATH]",
    .of = MeasureOf::Parallel,
    .axis = "progress distance",
    .doc =
        "the sum, over its ticks and all pairs of its children, of how far their progress is "
        "apart; taken before the children are ticked, completed children at 1. With `[K1:K2]` "
        "only over its ticks K1 to K2, counted from 0",
    .make = make_distance,
    .is_possible = is_sum,
    .parse = parse_samples};

extern const Measure kProgressDistanceMean{
    .name = "progress-distance-mean",
    .argument = kOneParallel,
    .of = MeasureOf::Parallel,
    .axis = "progress distance per tick",
    .doc = "the progress distance, divided by the ticks of the parallel",
    .make = make_accumulator<ProgressDistanceMean>,
    .is_possible = is_sum};

extern const Measure kProgressDistanceSeconds{
    .name = "progress-distance-seconds",
    .argument = kOneParallel,
    .of = MeasureOf::Parallel,
    .axis = "progress distance",
    .unit = "s",
    .doc = "the progress distance times the period, so that it does not grow with the rate",
    .make = make_accumulator<ProgressDistanceSeconds>,
    .is_possible = is_sum};

}  // namespace lockstep::host
