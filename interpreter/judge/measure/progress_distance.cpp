#include "judge/measure/progress_distance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/core/synchronization.h"
#include "base/core/value.h"

namespace lockstep::host {

// The gap between two neighbors is part of the distance of each pair that lies around it.
template <class Number>
static double sum_of_gaps(std::size_t count, Number number) {
  double sum = 0;
  for (std::size_t i = 1; i < count; ++i) {
    sum += (number(i) - number(i - 1)) * static_cast<double>(i * (count - i));
  }
  return sum;
}

PairDistance::PairDistance(std::size_t numbers) : sorted_(numbers) {
  if (numbers <= kFew) return;
  order_.resize(numbers);
  std::iota(order_.begin(), order_.end(), 0u);
}

// False also where a number is left out, which is none.
bool PairDistance::is_ordered(std::span<const double> progress, double& sum) const {
  const std::size_t count = order_.size();
  double before = progress[order_[0]];
  for (std::size_t i = 1; i < count; ++i) {
    const double number = progress[order_[i]];
    if (!(before <= number)) return false;
    sum += (number - before) * static_cast<double>(i * (count - i));
    before = number;
  }
  return true;
}

// Most of the order is often the same as before.
double PairDistance::of_new_order(std::span<const double> progress) {
  if (std::ranges::any_of(progress, is_left_out)) return of_few(progress);
  const auto is_less = [&](std::uint32_t one, std::uint32_t other) {
    return progress[one] < progress[other];
  };
  std::size_t moves_left = 8 * order_.size();
  for (auto it = order_.begin() + 1; it != order_.end(); ++it) {
    const std::uint32_t place = *it;
    auto to = it;
    for (; to != order_.begin() && is_less(place, *(to - 1)); --to) {
      *to = *(to - 1);
      if (moves_left != 0) --moves_left;
    }
    *to = place;
    if (moves_left != 0) continue;
    std::ranges::sort(order_, is_less);
    break;
  }
  return sum_of_gaps(order_.size(), [&](std::size_t i) { return progress[order_[i]]; });
}

// A general sort takes most of the time for the few children that a parallel has.
double PairDistance::of_few(std::span<const double> progress) {
  if (progress.size() == 2) {
    const bool is_alone = is_left_out(progress[0]) || is_left_out(progress[1]);
    return is_alone ? 0 : std::abs(progress[0] - progress[1]);
  }
  std::size_t count = 0;
  for (const double number : progress) {
    if (is_left_out(number)) continue;
    std::size_t place = count++;
    if (progress.size() <= kFew) {
      for (; place > 0 && sorted_[place - 1] > number; --place) sorted_[place] = sorted_[place - 1];
    }
    sorted_[place] = number;
  }
  if (progress.size() > kFew) std::ranges::sort(std::span(sorted_).first(count));
  return sum_of_gaps(count, [&](std::size_t i) { return sorted_[i]; });
}

void ProgressDistance::after_tick(const TickView& view) {
  const SynchronizedTick& tick = view.parallels[place_];
  if (!tick.ticked) return;
  const std::uint64_t sample = seen_++;
  if (sample < range_.first || sample > range_.last) return;
  ++samples_;
  sum_ += distance_.of(tick.progress);
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
    .parse = parse_samples,
    .counts_from_start = [](const MeasureSpec& spec) { return !spec.numbers.empty(); }};

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
