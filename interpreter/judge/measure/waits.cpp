// How long a node had to wait for its resources at most: no other node may own them again and again
// in between, as the promise of fairness says.
#include <algorithm>
#include <cstdint>

#include "base/core/resource_set.h"
#include "judge/measure/measure.h"

namespace lockstep::host {
namespace {

class LongestWait final : public Accumulator {
 public:
  explicit LongestWait(const MeasureTarget& target) : node_(target.nodes[0]) {}

  void reset() override {
    reached_ = false;
    now_ = longest_ = 0;
  }

  // Pools keep over a cut who waits.
  void join(Joint joint) override {
    if (joint == Joint::Lost) now_ = 0;
  }

  void after_tick(const TickView& view) override {
    const Moment& moment = *view.moment;
    const bool ticked = moment.ticked(node_);
    reached_ |= ticked;
    now_ = ticked && waits(moment.limit(node_)) ? now_ + 1 : 0;
    longest_ = std::max(longest_, now_);
  }

  double value(const EndView&) const override {
    return reached_ ? static_cast<double>(longest_) : kNoValue;
  }

 private:
  NodeIndex node_;
  bool reached_ = false;                 // by any tick
  std::uint64_t now_ = 0, longest_ = 0;  // in a row
};

}  // namespace

extern const Measure kWaits{
    .name = "waits",
    .argument = ":NODE",
    .of = MeasureOf::User,
    .axis = "longest wait",
    .unit = "ticks",
    .doc =
        "the most ticks in a row in which NODE was reached and did not get its resources, because "
        "others owned them",
    .make = make_accumulator<LongestWait>,
    .is_possible = is_count_of_ticks};

}  // namespace lockstep::host
