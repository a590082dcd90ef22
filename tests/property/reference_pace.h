// The law of pacing once more: the factors that a synchronized node gives to what it holds.
#pragma once

#include <vector>

#include "base/core/clock.h"
#include "property/plan.h"

namespace lockstep::host::test {

class ReferenceNode;

// "∅: nobody is asked for anything."
inline constexpr double kNothingAsked = 0;
double product_of(double given, double asked);
double or_full(double given);

class ReferencePacer {
 public:
  ReferencePacer(const Plan& plan, std::size_t children) : plan_(plan), children_(children) {}

  struct Child {
    ReferenceNode* node;
    double reached;
    bool takes_part;  // Running at the snapshot, not completed, no guard
    bool was_ticked;  // by the node's last tick
    bool is_held;
    bool is_guard;
  };
  // Before the children are ticked. `limit`: infinity if none is left.
  void tick(const std::vector<Child>& all, double limit, bool asks, double given, Nanoseconds now,
            bool begins);
  void pause(Nanoseconds now) { until_ = now; }

  double told(std::size_t child) const { return children_[child].told; }
  double given(std::size_t child) const { return children_[child].given; }

 private:
  struct Paced {
    double e0 = 0, full = 0, counts = 1, told = 1, rate = 0, given = kNothingAsked;
  };
  void learn(const Child& child, Paced& it, double seconds) const;

  const Plan& plan_;
  std::vector<Paced> children_;
  Nanoseconds last_{0};
  Nanoseconds until_{-1};  // of a node that is held
  double given_ = kNothingAsked;
};

}  // namespace lockstep::host::test
