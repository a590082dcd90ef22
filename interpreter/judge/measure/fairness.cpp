// How evenly the members of a pool shared it. R. Jain, D. Chiu, W. Hawe, A Quantitative Measure of
// Fairness and Discrimination for Resource Allocation in Shared Computer Systems, DEC-TR-301, 1984.
#include <algorithm>
#include <vector>

#include "base/core/resource_set.h"
#include "judge/measure/measure.h"

namespace lockstep::host {
namespace {

class Fairness final : public Accumulator {
 public:
  explicit Fairness(const MeasureTarget& target)
      : members_(target.nodes), ticks_(target.nodes.size()) {}

  void reset() override { std::ranges::fill(ticks_, 0); }

  void after_tick(const TickView& view) override {
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      ticks_[i] += owns(view.moment->limit(members_[i]));
    }
  }

  double value(const EndView&) const override {
    double sum = 0, squares = 0;
    for (const double ticks : ticks_) {
      sum += ticks;
      squares += ticks * ticks;
    }
    const double members = static_cast<double>(ticks_.size());
    return sum == 0 ? kNoValue : std::min(1.0, sum * sum / (members * squares));
  }

 private:
  std::vector<NodeIndex> members_;
  std::vector<double> ticks_;  // in which each member owned its resources
};

}  // namespace

extern const Measure kFairness{
    .name = "fairness",
    .argument = ":POOL",
    .of = MeasureOf::Pool,
    .axis = "fairness index",
    .doc =
        "Jain's fairness index of the ticks in which each of the N members of POOL owned its "
        "resources: 1 for equal parts, 1/N if one member had all; no value if no member owned any",
    .make = make_accumulator<Fairness>,
    .is_possible = [](double value, const MeasureSpec&, const MeasuredRun&) {
      return value > 0 && value <= 1;
    }};

}  // namespace lockstep::host
