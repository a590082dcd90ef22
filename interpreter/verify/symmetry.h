// Children of a parallel that do the same: from a state in which two of them have changed places,
// the tree goes on as from the state before, but for their names. So a search looks at one of all
// such states: E. M. Clarke, R. Enders, T. Filkorn, S. Jha, "Exploiting Symmetry in Temporal Logic
// Model Checking", Formal Methods in System Design 9, 1996. Children that somebody can tell apart
// keep their places: members of groups, nodes that a property names, and nodes that use entries,
// since the first of two that write is not the second.
#pragma once

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

  static Place place_of(const Tree& tree, NodeIndex node);
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
  // Whether what is below it shares nothing with the nodes outside of it: it may have others like
  // it, or be the only one.
  bool is_on_its_own(NodeIndex node) const { return on_its_own_[node]; }
  // Nodes that may move and keep which child they are at: by how far behind the node it is, which
  // is the same at each place, or by its number. `words` are RunState::bytes.
  enum class Numbered : bool { FromNode, InTree };
  void number_kept_children(const Tree& tree, std::vector<std::uint64_t>& words, Numbered by) const;
  // Changes of places that put `node` where `other` is, which is like it: of each node its place.
  std::vector<NodeIndex> exchange(NodeIndex node, NodeIndex other) const;

 private:
  std::vector<EqualChildren> classes_;
  std::vector<NodeIndex> first_like_;  // of each node
  std::vector<bool> moves_, on_its_own_;
  std::vector<NodeIndex> keepers_;  // their state begins with the number of a child, or with 0
};

}  // namespace lockstep::host
