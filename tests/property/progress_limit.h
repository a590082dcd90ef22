// How far a child or a member may be: section "the synchronized tick" of the law.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "property/mini_script.h"
#include "property/plan.h"

namespace lockstep::host::test {

inline constexpr double kLeftOut = std::numeric_limits<double>::quiet_NaN();
inline bool is_left_out(double progress) {
  return std::isnan(progress);
}

// What a snapshot counts as the least: min(1, min e).
double least_of(const std::vector<double>& snapshot);

class ProgressLimit {
 public:
  // By the constants of a synchronized parallel or of a barrier beside the tree.
  explicit ProgressLimit(const Plan& plan);
  // The same, with what `entries` say now. Throws BadEntry.
  ProgressLimit(const Plan& plan, const Entries& entries);
  struct BadEntry {};

  bool holds(double progress, double least) const;
  // The progress at which it holds; infinity: it holds nobody.
  double farthest(double least) const;
  // A barrier at 0.
  bool begins_together() const { return !delta_ && !barriers_.empty() && barriers_[0] == 0; }

 private:
  std::optional<double> next_barrier(double least) const;
  void read_lists(const Plan& plan, const Entries& entries);

  std::optional<double> delta_;
  std::vector<double> barriers_;
  bool tick_at_barrier_ = false;
};

}  // namespace lockstep::host::test
