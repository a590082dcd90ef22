// A graph is what a search has found: the states as numbers, and what each tick from one of them
// did. The questions of a verdict are asked here, without the engine.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "verify/edge_rows.h"
#include "verify/label_table.h"

namespace lockstep::host {

struct Graph {
  EdgeRows edges;
  std::vector<bool> ends;  // of each state: some tick from it ends the run
  LabelTable labels;
  LabelShape shape;

  std::size_t states() const { return ends.size(); }
  // States that were looked at: their edges are known. Others may do anything.
  std::size_t expanded() const { return edges.states(); }
  EdgeRow edges_of(StateId state) const { return state < expanded() ? edges[state] : EdgeRow(); }
  bool has(const Edge& edge, std::size_t bit) const {
    return LabelTable::has(labels[edge.label], bit);
  }
  // Where an edge takes a leaf or a child, by its place among those that may move.
  std::size_t leaf_after(const Edge& edge, std::size_t moving) const {
    return shape.place_after(labels[edge.label], moving);
  }
  std::size_t held_after(const Edge& edge, std::size_t moving) const {
    const std::size_t leaves = shape.moving_leaves.size();
    return shape.place_after(labels[edge.label], leaves + moving) - leaves;
  }
  // The one before it that is in an equal state before the edge, or itself.
  std::size_t leaf_before(const Edge& edge, std::size_t moving) const {
    return shape.equal_before(labels[edge.label], moving);
  }
  // Calls it for each of the leaves that may move whose places this one may have before the edge:
  // itself, and those in equal states.
  template <class F>
  void for_each_equal(const Edge& edge, std::size_t moving, const F& call) const {
    const auto label = labels[edge.label];
    call(moving);
    if (!shape.has_equal(label)) return;
    for (std::size_t i = moving; shape.equal_before(label, i) != i;) {
      call(i = shape.equal_before(label, i));
    }
    for (std::size_t i = moving + 1, last = moving; i < shape.moving_leaves.size(); ++i) {
      if (shape.equal_before(label, i) == last) call(last = i);
    }
  }
};

// Two leaves in equal states that change places, by their places among those that may move.
struct Swap {
  std::size_t one = 0, other = 0;

  std::size_t operator()(std::size_t leaf) const {
    return leaf == one ? other : leaf == other ? one : leaf;
  }
};
using Swaps = std::array<Swap, 2>;  // the first one first

// A way through a graph, edge by edge.
struct CycleStep {
  StateId from;
  Edge edge;
  Swaps swaps = {};  // before the edge
};
// The edges that it may use.
using EdgeFilter = std::function<bool(const Edge&)>;

// Says of each state whether some way leads from it to an end, or to a state that was not looked
// at.
std::vector<bool> can_end(const Graph& graph);

// The states to which some way leads from this one, which is one of them.
std::vector<bool> reachable_from(const Graph& graph, StateId from);

// Whether some cycle has an edge like this.
bool recurs(const Graph& graph, const EdgeFilter& is_wanted);

// How many edges like this may follow each other: nothing if there is no end.
std::optional<std::uint64_t> longest_row(const Graph& graph, const EdgeFilter& is_wanted);

// From `from` the shortest way to a state for which `is_goal`, over the edges of the graph.
std::vector<CycleStep> shortest_way(const Graph& graph, StateId from,
                                    const std::vector<bool>& is_goal);

}  // namespace lockstep::host
