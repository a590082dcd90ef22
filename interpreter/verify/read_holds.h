// Of which nodes a state says that they are held: those of which some node reads it, those that
// the next tick may pass over (NodeKind), and those of which a property is asked: in the first
// moment of a tick they may still be held by the one before. All others are held again by the next
// tick, so they count as if they ran.
#pragma once

#include <vector>

#include "engine/ticker.h"

namespace lockstep::host {

class ReadHolds {
 public:
  // `leaves`: of each leaf, whether it is not the same held or not. `watched`: the nodes of
  // properties and those above them; none, if it is empty. The tree must outlive this.
  ReadHolds(const Tree& tree, const std::vector<bool>& leaves,
            const std::vector<bool>& watched = {});

  // `activity` is that of the run, of each node.
  void forget_others(const Ticker& ticker, std::vector<Activity>& activity) const;

 private:
  bool is_read_by_group(const Ticker& ticker, NodeIndex node) const;

  const Tree& tree_;
  std::vector<bool> by_itself_;        // of each node
  std::vector<NodeIndex> by_a_group_;  // in pre-order
};

}  // namespace lockstep::host
