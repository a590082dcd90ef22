// The law of "resources" once more: pools beside the tree, and UseResources.
#pragma once

#include <set>

#include "property/reference_group.h"

namespace lockstep::host::test {

using Resources = std::set<std::string>;

class ReferencePool : public ReferenceGroup {
 public:
  ReferencePool(Reference& tree, const Plan& its_plan, ReferenceNode& root);

  void before_tick() override;
  double on_progress() override { return 0; }

  bool has_member(const ReferenceNode& node) const { return place_of(node) < count(); }
  void reach() { last_tick = world.tick; }
  bool knows(const std::string& name) const { return names_.contains(name); }
  bool is_free(const Resources& set) const;  // in this tick
  void give(const Resources& set) { owned_.insert(set.begin(), set.end()); }
  void take_back(const Resources& set);
  bool is_owned(const std::string& name) const;  // when a tick begins: by one that still runs
  int increment() const { return plan.increment; }
  // "saturating at 2 N x increment"
  int most_priority() const { return 2 * static_cast<int>(count()) * plan.increment; }

 private:
  Resources names_, owned_;
};

class UseResources : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override;
  double on_progress() override { return child().progress(); }
  void keep(KeptState& state) override;

  // Before the root is ticked.
  bool keeps() { return plan.keep && !owned_.empty() && child().runs(); }
  void keep_set();
  bool is_active() const { return runs() && !was_held_by_parallel(); }
  Resources wanted() const;
  bool is_right(const Resources& names) const;
  void ask();
  // When a tick begins: whether it owned that in the last one.
  bool owned(const std::string& name) const {
    return runs() && asked_in_ + 1 == world.tick && is_granted_ && owned_.contains(name);
  }
  int priority() const { return priority_; }
  // In this tick, and as far as has been asked.
  bool is_granted() const { return asked_in_ == world.tick && is_granted_; }

 private:
  ReferencePool& pool() const;
  Status deny();
  void note_kept() const;
  bool has_open_gates() const;
  const ReferenceNode* directly_inside() const;
  bool is_closed(const std::string& gate) const;
  bool was_held_by_parallel() const;

  std::uint32_t asked_in_ = 0;                 // the last tick in which it asked
  bool is_granted_ = false, is_open_ = false;  // then
  Resources owned_;                            // since then
  int priority_ = 0;
};

}  // namespace lockstep::host::test
