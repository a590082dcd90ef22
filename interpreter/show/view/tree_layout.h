// Chooses the nodes of a tree to show when there are fewer rows than nodes. Pure: knows no terminal
// and draws nothing.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/core/status.h"
#include "record/live/snapshot.h"
#include "trace/shape.h"

namespace lockstep::host {

// The user's choices.
struct Browsing {
  std::set<NodeIndex> folded = {};       // the nodes below these are not shown
  std::optional<NodeIndex> cursor = {};  // its surroundings are shown; none: what runs is
};

// How many nodes are in each state.
class Tally {
 public:
  void add(Activity activity);
  std::size_t sum() const;
  // "2 running, 1 waiting, 9 idle"
  std::string text() const;

 private:
  std::size_t waiting_ = 0;
  std::array<std::size_t, kStatuses.size()> others_{};  // by status
};

struct Layout {
  std::vector<NodeIndex> rows = {};  // in the order of the tree
  std::size_t first = 0;             // around a cursor: how many rows there are before these
  std::size_t all = 0;               // how many rows there would be with enough room
  Tally left_out = {};               // nodes that have no row, but for those that are folded
};

// At most `room` rows, at least 1; one of them is left free for a note when there are more nodes.
// Without a cursor: running nodes first, then waiting ones, then completed and idle ones, the
// nearest to the running nodes first.
Layout lay_out(const Shape& tree, const Snapshot& snapshot, const Browsing& browsing,
               std::size_t room);

// The nodes that have a row with enough room, in the order of the tree.
std::vector<NodeIndex> unfolded(const Shape& tree, const std::set<NodeIndex>& folded);
// The nodes below one.
Tally tally_below(const Shape& tree, const Snapshot& snapshot, NodeIndex node);

}  // namespace lockstep::host
