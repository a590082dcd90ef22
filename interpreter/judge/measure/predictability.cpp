#include "judge/measure/predictability.h"

#include <algorithm>
#include <cmath>

#include "base/core/value.h"

namespace lockstep::host {
namespace {

constexpr double kEqualGap = 1e-9;

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

void Predictability::after_tick(const TickView& view) {
  const Moment& moment = *view.moment;
  nearest_.sample(static_cast<double>(moment.tick), moment.progress[node_]);
  ticks_ = static_cast<double>(moment.tick + 1);
  ticked_ |= moment.ticked(node_);
  succeeded_ = moment.status(node_) == Status::Success;
}

NearestInstant Predictability::nearest() const {
  NearestInstant nearest = nearest_;
  if (succeeded_) nearest.sample(ticks_, 1);
  return nearest;
}

double Predictability::value(const EndView&) const {
  const NearestInstant it = nearest();
  return ticked_ && it.reached() ? it.time() - expected_ : kNoValue;
}

double Predictability::gap() const {
  if (!ticked_) return kNoValue;
  const double gap = nearest().gap();
  return gap <= kEqualGap ? 0 : gap;
}

namespace {

// The numbers of a spec are P, and T where it is given.
double expected_of(const MeasureSpec& spec) {
  return spec.numbers.size() > 1 ? spec.numbers[1] : 0;
}

// ":NODE@P[=T]". A path may hold '@' and '=', so P is what follows the last '@'.
std::string parse_predictability(std::string_view argument, MeasureSpec& spec) {
  const auto at = argument.rfind('@');
  if (!argument.starts_with(':') || at == std::string_view::npos || at == 1) {
    return "expected 'predictability:NODE@P' or 'predictability:NODE@P=T'";
  }
  const auto equals = std::min(argument.find('=', at), argument.size());
  const std::string progress_text(argument.substr(at + 1, equals - at - 1));
  const auto progress = parse_double(progress_text);
  if (!progress || *progress < 0 || *progress > 1) {
    return "the progress after '@' is '" + progress_text + "', expected a number from 0 to 1";
  }
  spec.name = argument.substr(1, at - 1);
  spec.numbers = {*progress};
  spec.argument = ":" + spec.name + "@" + to_text(Value(*progress));
  if (equals == argument.size()) return {};
  const std::string expected_text(argument.substr(equals + 1));
  const auto expected = parse_double(expected_text);
  if (!expected || *expected < 0) {
    return "the instant after '=' is '" + expected_text + "', expected a number of ticks from 0";
  }
  spec.numbers.push_back(*expected);
  spec.argument += "=" + to_text(Value(*expected));
  return {};
}

// A number of ticks, minus the expected one.
bool is_instant(double value, const MeasureSpec& spec, const MeasuredRun& run) {
  const double expected = expected_of(spec);
  const double instant = std::round(value + expected);
  return instant >= 0 && instant <= static_cast<double>(run.ticks) && instant - expected == value;
}

}  // namespace

extern const Measure kPredictability{
    .name = "predictability",
    .argument = ":NODE@P[=T]",
    .of = MeasureOf::Node,
    .axis = "predictability distance",
    .unit = "ticks",
    .doc =
        "the first tick, from 0, before which the node's progress was nearest to P; with T, the "
        "same minus T, so that negative is early",
    .has_gap = true,
    .make = [](const MeasureSpec& spec,
               const MeasureTarget& target) -> std::unique_ptr<Accumulator> {
      return std::make_unique<Predictability>(target.nodes[0], spec.numbers[0], expected_of(spec));
    },
    .is_possible = is_instant,
    .parse = parse_predictability,
    .label =
        [](const MeasureSpec& spec) {
          const bool is_distance = spec.numbers.size() > 1;
          const std::string what =
              is_distance ? "predictability distance at " : "instant of progress ";
          return what + to_text(Value(spec.numbers[0])) + " (ticks)";
        },
    .counts_from_start = [](const MeasureSpec&) { return true; }};

}  // namespace lockstep::host
