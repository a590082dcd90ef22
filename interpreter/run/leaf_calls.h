// The ticks that the leaves of a run or of a recording got: one for each moment of a tick that has
// reached the leaf. An action that has completed and keeps its result, as the condition of a
// WhileDoElse of BehaviorTree.CPP, is reached without a tick.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/tree.h"
#include "trace/moment.h"
#include "trace/shape.h"

namespace lockstep::host {

class LeafCalls {
 public:
  struct Call {
    Status status;  // after it; Idle: an ancestor has ended it in the same tick
    bool begins;    // an activation
    // The moment that begins with it, by its number in the tick; none: the next tick does.
    std::optional<std::size_t> next = {};
  };

  // Of the leaves that the tree has at the path of a node of the shape.
  LeafCalls(const Shape& shape, const Tree& tree);

  struct Leaf {
    NodeIndex node;  // in the shape
    const LeafNode* leaf;
  };
  const std::vector<Leaf>& leaves() const { return leaves_; }

  // That of a leaf at the start of a moment, or of the tick. A node that compares progress may have
  // compared another number, and in a later moment.
  double progress_at(const Moment& tick, NodeIndex leaf, std::size_t moment) const;
  // Of a run that continues after a cut: what its nodes did before the first tick.
  void begin(const Moment& before);
  // The next tick. Does not allocate, unless a leaf gets more ticks in it than in any before.
  void take(const Moment& tick);
  // What the leaf of this number got in it.
  std::span<const Call> of(std::size_t leaf) const { return followed_[leaf].calls; }

 private:
  struct Followed {
    std::optional<NodeIndex> keeper;  // its parent, if that does not begin it again
    Status before = Status::Idle, keeper_before = Status::Idle;
    std::vector<Call> calls = {};
  };
  template <class StateOf>
  void reach(const StateOf& state_of, std::optional<std::size_t> next = {});

  const Shape& shape_;
  std::vector<Leaf> leaves_;
  std::vector<Followed> followed_;  // of each leaf
  std::vector<NodeState> moment_;
};

}  // namespace lockstep::host
