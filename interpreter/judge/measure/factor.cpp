// How a node that is paced was slowed (trace/moment.h): its factor, and how restless its speed was.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "judge/measure/measure.h"

namespace lockstep::host {
namespace {

// That of the nearest child of a node that paces among `path`, the node and those around it. Each
// has that of the nodes around it in it, so none is larger than those.
double least_factor(const Moment& moment, std::span<const NodeIndex> path) {
  double least = 1;
  for (const NodeIndex node : path) least = std::min(least, moment.factor(node));
  return least;
}

class Factor final : public Accumulator {
 public:
  explicit Factor(const MeasureTarget& target) : path_(target.nodes) {}

  void reset() override { sum_ = ticks_ = 0; }
  void after_tick(const TickView& view) override {
    if (!view.moment->ticked(path_.front())) return;
    sum_ += least_factor(*view.moment, path_);
    ++ticks_;
  }
  double value(const EndView&) const override { return ticks_ > 0 ? sum_ / ticks_ : kNoValue; }

 private:
  const std::vector<NodeIndex> path_;
  double sum_ = 0, ticks_ = 0;
};

// The speed is the factor, and 0 while the node is held.
class SpeedChanges final : public Accumulator {
 public:
  explicit SpeedChanges(const MeasureTarget& target) : path_(target.nodes) {}

  void reset() override {
    sum_ = kNoValue;
    speed_.reset();
  }
  void after_tick(const TickView& view) override {
    const Moment& moment = *view.moment;
    const NodeIndex node = path_.front();
    if (moment.status(node) != Status::Running) return speed_.reset();
    const double speed = moment.held(node) ? 0 : least_factor(moment, path_);
    if (std::isnan(sum_)) sum_ = 0;
    if (speed_) sum_ += std::abs(speed - *speed_);
    speed_ = speed;
  }
  double value(const EndView&) const override { return sum_; }

 private:
  const std::vector<NodeIndex> path_;
  double sum_ = kNoValue;
  std::optional<double> speed_;  // after the last tick, while it runs
};

}  // namespace

extern const Measure kFactor{
    .name = "factor",
    .argument = ":NODE",
    .of = MeasureOf::Node,
    .axis = "factor",
    .doc =
        "the factor that NODE gets from nodes with pace=\"true\", as the mean of the ticks that "
        "NODE received: 1 is full speed",
    .make = make_accumulator<Factor>,
    .is_possible = is_share};

extern const Measure kSpeedChanges{
    .name = "speed-changes",
    .argument = ":NODE",
    .of = MeasureOf::Node,
    .axis = "changes of the speed",
    .doc =
        "the sum of all changes of the speed of NODE while it runs: the speed is its factor, "
        "and 0 while it is held. A pause counts 2",
    .make = make_accumulator<SpeedChanges>,
    .is_possible = is_sum};

}  // namespace lockstep::host
