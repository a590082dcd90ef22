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
#include "verify/time_limit.h"

namespace lockstep::host {

struct Graph {
  EdgeRows edges;
  // Of each state: some tick from it ends the run, without a cut before it.
  std::vector<bool> ends;
  // Of each state, how often the process was cut until then; empty: no process is cut.
  std::vector<std::uint8_t> cuts = {};
  LabelTable labels;
  LabelShape shape;
  // Of each state that was looked at, if something may change places: see read_equals.
  std::vector<std::uint32_t> equals = {};
  TimeLimit* time_limit = nullptr;  // must outlive this; one thread walks then

  std::size_t states() const { return ends.size(); }
  // States that were looked at: their edges are known. Others may do anything.
  std::size_t expanded() const { return edges.states(); }
  std::size_t memory() const {
    return edges.memory() + labels.memory() + equals.size() * sizeof equals[0] + cuts.size();
  }
  EdgeRow edges_of(StateId state) const {
    if (time_limit != nullptr) time_limit->look();
    return state < expanded() ? edges[state] : EdgeRow();
  }
  bool is_cut(StateId from, const Edge& edge) const {
    return !cuts.empty() && cuts[from] != cuts[edge.to];
  }
  bool has(const Edge& edge, std::size_t bit) const { return labels.has(edge.label, bit); }
  void read(const Edge& edge, Label& into) const {
    shape.clear(into);
    labels.read(edge.label, into);
  }
  // Of each place: the one before it with which it may change places in this state, or itself.
  void read_equals(StateId state, Label& into) const {
    shape.clear(into);
    if (state < equals.size()) labels.read(equals[state], into);
  }
};

// Calls it for each of the places that what is at this one may have: its own first.
template <class F>
void for_each_equal(const Label& equals, std::size_t place, const F& call) {
  call(place);
  for (std::size_t i = place; equals.after[i] != i;) call(i = equals.after[i]);
  for (std::size_t i = place + 1, last = place; i < equals.after.size(); ++i) {
    if (equals.after[i] == last) call(last = i);
  }
}

using Swaps = std::array<Swap, 2>;  // the first one first

// A path through a graph, edge by edge.
struct CycleStep {
  StateId from;
  Edge edge;
  Swaps swaps = {};  // before the edge
  Swap after = {};   // behind it
};
// The edges that it may use.
using EdgeFilter = std::function<bool(const Edge&)>;

// Says of each state whether some path leads from it to an end, or to a state that was not looked
// at. A cut helps no run.
std::vector<bool> can_end(const Graph& graph);

// The states to which some path without a cut leads from this one, which is one of them.
std::vector<bool> reachable_from(const Graph& graph, StateId from);

// Whether some cycle has an edge like this.
bool recurs(const Graph& graph, const EdgeFilter& is_wanted);

// How many ticks with such a label may follow each other, the last of the run too: nothing if there
// is no end.
using LabelFilter = std::function<bool(std::uint32_t label)>;
std::optional<std::uint64_t> longest_row(const Graph& graph, const LabelFilter& is_wanted);

// From `from` the shortest path without a cut to a state for which `is_goal`.
std::vector<CycleStep> shortest_path(const Graph& graph, StateId from,
                                     const std::vector<bool>& is_goal);

}  // namespace lockstep::host
