// The law of "resources" once more: pools beside the tree, and UseResources.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "property/reference_group.h"

namespace lockstep::host::test {

using Resources = std::set<std::string>;

// "A;any(B;C)": all of the first, and one of the second if there are some.
struct Wish {
  Resources all;
  std::vector<std::string> any;

  Resources everything() const;
};

class UseResources;

class ReferencePool : public ReferenceGroup {
 public:
  ReferencePool(Reference& tree, const Plan& its_plan, ReferenceNode& root);

  void before_tick() override;
  double on_progress() override { return 0; }

  bool has_member(const ReferenceNode& node) const { return place_of(node) < count(); }
  void reach() { last_tick = world.tick; }
  bool knows(const std::string& name) const { return std::ranges::count(names_, name) != 0; }
  bool is_owned(const std::string& name) const;  // when a tick begins: by one that still runs
  // In the order of the pool.
  std::string text_of(const Resources& set) const;
  int increment() const { return plan.increment; }
  // "saturating at 2 N x increment"
  int most_priority() const { return 2 * static_cast<int>(count()) * plan.increment; }

  UseResources& user(std::size_t place) const;
  std::size_t users() const { return count(); }

 private:
  void add_names(std::string list);

  std::vector<std::string> names_;
};

class UseResources : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override;
  double on_progress() override { return child().progress(); }
  void keep(KeptState& state) override;

  // Before the root is ticked.
  bool keeps() {
    const bool may_keep = plan.keep || exchanges() || plan.on_change == "keep";
    return may_keep && !owned_.empty() && child().runs();
  }
  bool exchanges() const { return plan.on_change == "exchange"; }
  // What it has whatever the answer is.
  Resources kept() { return keeps() ? owned_ : handed_; }
  // It is for another set than what it keeps.
  bool wants_another() const;
  void keep_set();
  void keep_old_set() { in_tick_ = kept(); }
  void begin_tick() { in_tick_.clear(); }
  bool is_active() const { return runs() && !was_held_by_parallel(); }
  Wish wanted() const;
  bool is_right(const Wish& wish) const;
  void ask();
  void ask_after_outer(const std::vector<UseResources*>& asking);
  // When a tick begins: whether it owned that in the last one.
  bool owned(const std::string& name) const { return runs() && in_tick_.contains(name); }
  int priority() const { return priority_; }
  // In this tick, and as far as has been asked.
  bool is_granted() const { return asked_in_ == world.tick && is_granted_; }

 private:
  ReferencePool& pool() const;
  bool is_inside_of(const ReferenceNode& other) const;
  bool is_related(const UseResources& other) const;
  bool takes_over_from(const UseResources& other);
  bool is_free(const Resources& set);
  Resources handed_over();
  Resources choose(const Wish& wish);
  void write_granted();
  Status deny();
  void note_kept() const;
  bool has_open_gates() const;
  const ReferenceNode* directly_inside() const;
  bool is_closed(const std::string& gate) const;
  bool was_held_by_parallel() const;

  std::uint32_t asked_in_ = 0;                 // the last tick in which it asked
  bool is_granted_ = false, is_open_ = false;  // then
  Resources owned_;                            // since its last grant, while its child runs
  Resources granted_;                          // in this tick
  Resources in_tick_;                          // in this tick, with what it exchanges
  Resources handed_;                           // by those before it, until its child runs
  int priority_ = 0;
};

}  // namespace lockstep::host::test
