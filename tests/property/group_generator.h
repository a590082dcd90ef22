// Draws random trees of barriers and pools: below one node, ways of all kinds lead to members.
#pragma once

#include "property/tree_generator.h"

namespace lockstep::host::test {

class GroupGenerator : public TreeGenerator {
 public:
  explicit GroupGenerator(std::uint64_t seed) : TreeGenerator(seed) {}
  Trial trial();

 private:
  void draw_groups();
  void take_from_entry(Plan& group);
  void draw_writes(Trial& trial);
  EntryWrite write(int tick, const std::string& entry);

  Plan node(int depth) override;
  // The lowest node that has all of them below it, and what is around it.
  Plan common_ancestor(int depth);
  Plan around(int depth);
  // A subtree with a member in it.
  Plan way(int depth);
  Plan member(int depth);
  Plan pool_member(int depth);
  Plan row_of_pool_members(int depth);
  Plan outliving_parallel();
  Plan node_on_way(int depth);
  Plan parallel_on_way(int depth);
  Plan ordered_on_way(int depth);
  Plan branches_on_way(int depth);
  Plan decorator_on_way(int depth);
  Plan subtree_on_way(int depth);
  void ends_late(Plan& parallel);
  Plan working_leaf();

  // So many nodes more on the way, and then a parallel that outlives its member; 0: as it comes.
  int links_ = 0;
  std::vector<Plan> groups_;
  std::vector<std::string> keys_;  // of entries that groups and their members have
};

}  // namespace lockstep::host::test
