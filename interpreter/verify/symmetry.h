// Children of a parallel that do the same: from a state in which two of them have changed places,
// the tree goes on as from the state before, but for their names. So a search looks at one of all
// such states: E. M. Clarke, R. Enders, T. Filkorn, S. Jha, "Exploiting Symmetry in Temporal Logic
// Model Checking", Formal Methods in System Design 9, 1996. Children that somebody can tell apart
// keep their places: members of groups, nodes that a property names, and nodes that use entries,
// since the first of two that write is not the second.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "leaves/models.h"

namespace lockstep::host {

// The equal children of one parallel.
struct EqualChildren {
  struct Place {
    NodeIndex node;
    std::uint32_t leaf, word;  // the first of Tree::leaves and of RunState::bytes
  };
  std::uint32_t nodes, leaves, words;  // of each child
  std::vector<Place> places;           // of the children, in the order of the tree

  // Children in equal states may change places before a tick by no more than their one leaf: there
  // is one in each, and nobody inside is held. Then a tick needs one order of their answers.
  bool has_one_leaf = false;

  bool are_leaves() const { return nodes == 1 && leaves == 1 && words == 0; }
};

class Symmetry {
 public:
  // Nothing may change places.
  Symmetry() = default;
  // `watched`: of each node, whether a property looks at it.
  Symmetry(const Tree& tree, const LeafModels& models, const std::vector<bool>& watched);

  bool empty() const { return classes_.empty(); }
  // Classes inside of a child are before the class of the child.
  std::span<const EqualChildren> classes() const { return classes_; }

  // The first of the nodes that can come to the place of this one.
  NodeIndex first_like(NodeIndex node) const { return empty() ? node : first_like_[node]; }
  // Whether other nodes can come to its place.
  bool moves(NodeIndex node) const { return !empty() && moves_[node]; }
  // The nodes that may move and whose state begins with the number of a child, or with 0.
  std::span<const NodeIndex> keepers() const { return keepers_; }
  // Of a leaf that may change places with others before a tick: the child that moves with it, and
  // how many nodes it has. Nothing: the leaf is in no child with one leaf.
  struct Moved {
    NodeIndex child = 0, nodes = 0;
  };
  std::optional<Moved> moved_with(NodeIndex leaf) const {
    return empty() || moved_[leaf].nodes == 0 ? std::nullopt : std::optional(moved_[leaf]);
  }
  // Changes of places that put `node` where `other` is, which is like it: of each node its place.
  std::vector<NodeIndex> exchange(NodeIndex node, NodeIndex other) const;

 private:
  std::vector<EqualChildren> classes_;
  std::vector<NodeIndex> first_like_;  // of each node
  std::vector<bool> moves_;
  std::vector<Moved> moved_;  // of each node that is in a child with one leaf
  std::vector<NodeIndex> keepers_;
};

}  // namespace lockstep::host
