// The law of "progress across branches" once more: barriers beside the tree, and SyncProgress.
#pragma once

#include "property/progress_limit.h"
#include "property/reference_group.h"
#include "property/reference_pace.h"

namespace lockstep::host::test {

// Among the cases, this one is an error of the law itself.
inline constexpr auto kGoneComesBack = "a member that cannot come back does";

class ReferenceBarrier : public ReferenceGroup {
 public:
  ReferenceBarrier(Reference& tree, const Plan& its_plan, ReferenceNode& root);

  void before_tick() override;
  void was_ticked(const ReferenceNode& node) override;
  double on_progress() override { return least_of(snapshot); }
  void keep(KeptState& state) override;
  // What the barrier asks of it.
  double pace_of(const ReferenceNode& node) const {
    return plan.pace ? pacer_.given(place_of(node)) : kNothingAsked;
  }

  bool has_member(const ReferenceNode& node) const { return place_of(node) < count(); }
  bool holds(const ReferenceNode& node) const { return members_[place_of(node)].is_held; }
  bool is_reached_between(const ReferenceNode& node, const std::function<double()>& progress) const;
  // A tick has reached a member.
  void reach(const ReferenceNode& member);

 private:
  // Since C began its activation.
  struct Member {
    bool was_begun = false;
    bool has_succeeded = false;
    bool is_held = false;     // in this tick
    bool has_failed = false;  // its last result
    bool is_gone = false;     // it has counted as one that cannot come back
  };

  double counted(std::size_t place);
  double idle() const { return plan.ignores_idle ? kLeftOut : 0; }
  bool is_left_out(std::size_t place) const;
  bool cannot_come_back(std::size_t place) const;
  std::string doubt(std::size_t place, std::size_t parallel) const;
  bool never_begins_again(const ReferenceNode& node, const ReferenceNode& below) const;
  ProgressLimit limit() const;
  void read_limit();  // while no member runs
  bool somebody_runs() const;
  void hold(std::size_t place, const ProgressLimit& limit);
  bool begins_together() const;
  void hold_beginners();
  void hold_all_that_have_not_begun();
  bool all_succeeded() const;
  void pace();

  // The cases that came up.
  void note_counted(std::size_t place, double progress);
  void note_gone(std::size_t place, std::size_t parallel) const;
  void note_held(std::size_t place) const;

  std::vector<Member> members_;
  std::optional<ProgressLimit> limit_;  // of this tick
  ReferencePacer pacer_;
};

class SyncProgress : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override;
  double on_progress() override { return child().progress(); }
  bool is_held() const { return barrier().holds(*this); }
  bool is_reached_between(const std::function<double()>& progress) const override {
    return barrier().is_reached_between(*this, progress);
  }

 private:
  ReferenceBarrier& barrier() const;
};

}  // namespace lockstep::host::test
