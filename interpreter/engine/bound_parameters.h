// The parameters of built-in nodes in one run. Constants are cells of the tree. If a tree has
// parameters from entries, the run has its own copy of the cells. An entry that was written since
// the node's last tick is checked like a constant and then stored in its cell.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/core/value.h"
#include "engine/node.h"

namespace lockstep::host {

struct Blackboard;
struct BoundNode;
struct Tree;

class BoundParameters {
 public:
  // `tree` and `board` must outlive this.
  BoundParameters(const Tree& tree, const Blackboard& board);
  BoundParameters(const BoundParameters&) = delete;
  BoundParameters& operator=(const BoundParameters&) = delete;

  const Blackboard& board() const { return board_; }
  const Cell* cells() const { return cells_; }
  std::span<const double> numbers(NodeIndex node, unsigned index) const {
    const Cell& cell = cells_[nodes_[node].params + index];
    return {numbers_ + cell.list.first, cell.list.count};
  }
  // A list of texts that is a constant.
  std::span<const std::string> texts(NodeIndex node, unsigned index) const;
  // A text that is a constant; null: it is left out.
  const std::string* text(NodeIndex node, unsigned index) const;
  // No entry gives a parameter of the node.
  bool are_constant(NodeIndex node) const { return !nodes_[node].kind->reads_entries; }
  // As above, or no node of the tree writes these entries. Only for a fold, since a person may
  // write them.
  bool are_fixed(NodeIndex node) const;

  // Stores the entries of a node's parameters that were written. Returns "" or the error in a
  // value; after an error the node's cells are unchanged. Allocates only for longer texts and
  // lists, or if the kind's rule does.
  std::string read(NodeIndex node);
  // The same for a node of Tree::bound, by its place there.
  std::string read_bound(std::uint32_t place);
  // Whether a node's entries still say what it has read. By its place in Tree::bound.
  bool are_up_to_date(std::uint32_t place) const;
  // As if the node had read these. It reads again in its next tick.
  void set(std::uint32_t place, const std::vector<Value>& values);
  // As new, for the next run.
  void reset();

  struct Values {
    std::vector<Value> values;         // as the rule sees them
    std::vector<std::uint32_t> seen;   // of each: Entry::writes when it was read
    std::vector<std::uint32_t> space;  // of each list: how many numbers fit behind its first
    bool known = false;                // all entries were read once
  };
  // The run's copy of the entries that it has read. Empty when the tree has no bound nodes.
  struct State {
    std::vector<Cell> cells;
    std::vector<double> numbers;
    std::vector<Values> values;  // of each Tree::bound
  };
  const State& state() const { return own_; }
  // `from` is of this tree.
  void restore(const State& from);

 private:
  bool is_current(const BoundNode& node, const Values& values) const;
  std::string take_values(const BoundNode& node, Values& values) const;
  static bool take_value(const Parameter& parameter, const Value& from, Value& value);
  std::string missing(const BoundNode& node, unsigned parameter) const;
  std::string unreadable(const BoundNode& node, unsigned parameter) const;
  std::span<const std::string> pool_of(const BoundNode& node) const;
  std::optional<RuleBreak> refuse_resources(const BoundNode& node, const Parameter& parameter,
                                            const Value& value) const;
  std::string refusal(const BoundNode& node, unsigned parameter, const RuleBreak& why) const;
  void set_cells(const BoundNode& node, Values& values);
  void set_list(Cell& cell, std::uint32_t& space, std::span<const double> list);

  const Tree& tree_;
  const Node* const nodes_;  // of the tree
  const Blackboard& board_;
  const Cell* cells_;
  const double* numbers_;
  State own_;
};

}  // namespace lockstep::host
