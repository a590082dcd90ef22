// Brings the equal children of a state into one order, so that states that differ only in which of
// them is in which place are the same bytes.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/run_state.h"
#include "leaves/model_leaf.h"
#include "verify/symmetry.h"

namespace lockstep::host {

// The nodes and leaves of a run keep this, in the order of the tree.
struct KeptState {
  std::vector<Activity> activity;
  std::vector<std::uint64_t> words;
  std::vector<LeafState> leaves;
};

class ChildOrder {
 public:
  // Both must outlive this.
  ChildOrder(const Tree& tree, const Symmetry& symmetry);

  void sort(KeptState& state);
  // After `sort`: of each place, the node that was there before; empty if all are where they were.
  std::span<const NodeIndex> origins() const {
    return has_moved_ ? std::span<const NodeIndex>(origins_) : std::span<const NodeIndex>();
  }
  // Puts what each node keeps to another place: `places` has one for each node.
  void move(KeptState& state, std::span<const NodeIndex> places);

 private:
  void put_back();  // all are where they were
  bool sort_leaves(const EqualChildren& it, const KeptState& state);
  bool sort_subtrees(const EqualChildren& it, const KeptState& state);
  void apply(const EqualChildren& it, KeptState& state);

  const Tree& tree_;
  const Symmetry& symmetry_;
  bool has_moved_ = false;
  std::vector<NodeIndex> origins_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys_;  // of leaves, and their places
  std::vector<std::uint32_t> order_;                           // of places
  KeptState before_;
  std::vector<NodeIndex> origins_before_;
};

}  // namespace lockstep::host
