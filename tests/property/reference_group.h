// Of the reference interpreter: what is declared beside the tree, a barrier or a pool, and joins
// nodes anywhere in the tree, its members.
#pragma once

#include "property/reference_node.h"

namespace lockstep::host::test {

class ReferenceGroup : public ReferenceNode {
 public:
  // From the root to a member, both included.
  using Way = std::vector<ReferenceNode*>;

  ReferenceGroup(Reference& tree, const Plan& its_plan, ReferenceNode& root);

  // "One snapshot before the root is ticked."
  virtual void before_tick() = 0;
  // Each node of the tree, when its tick is over.
  virtual void was_ticked(const ReferenceNode& /*node*/) {}
  // What it shows: a group is idle while the ancestor does not run.
  void after_tick();

  // Of a group that has members. Which groups are asked first.
  bool is_inside_of(const ReferenceGroup& other) const;

 protected:
  std::size_t place_of(const ReferenceNode& member) const;
  ReferenceNode& member(std::size_t place) const { return *ways_[place].back(); }
  std::size_t count() const { return ways_.size(); }
  const Way& way(std::size_t place) const { return ways_[place]; }
  // "Let C be the lowest common ancestor of all members": its depth, and it.
  std::size_t ancestor_depth() const;
  ReferenceNode& ancestor() const { return *ways_[0][ancestor_depth()]; }

 private:
  // "an attribute on SubTree may remap it"
  void find_members(ReferenceNode& node, Way way, const GroupNames& names);
  Status on_tick(bool first) override;

  std::vector<Way> ways_;  // to each member, in document order
};

}  // namespace lockstep::host::test
