// What a search has found: the states as numbers, and what each tick from one of them did. The
// questions of a verdict are asked here, without the engine.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "verify/edge_rows.h"

namespace lockstep::host {

// What matters of a tick for a run that never ends, as bits: which leaves worked, which of them
// ended, and who was held. Few labels are different.
class LabelTable {
 public:
  using Bits = std::vector<std::byte>;

  std::uint32_t add(std::span<const std::byte> bits) { return bits_.add(bits).first; }
  std::span<const std::byte> operator[](std::uint32_t label) const { return bits_[label]; }
  std::size_t size() const { return bits_.size(); }
  std::size_t memory() const { return bits_.memory(); }
  static bool has(std::span<const std::byte> bits, std::size_t bit) {
    return (bits[bit / 8] >> bit % 8 & std::byte{1}) != std::byte{0};
  }
  static void set(Bits& bits, std::size_t bit) { bits[bit / 8] |= std::byte{1} << bit % 8; }

 private:
  StateStore bits_;
};

struct Graph {
  EdgeRows edges;
  std::vector<bool> ends;  // of each state: some tick from it ends the run
  LabelTable labels;
  std::size_t leaves = 0;  // bits: those that worked and go on, those that ended, who was held
  std::size_t held = 0;
  std::size_t properties = 0;  // and which of them wait for something

  // States that were looked at: their edges are known. Others may do anything.
  std::size_t expanded() const { return edges.states(); }
  EdgeRow edges_of(StateId state) const { return state < expanded() ? edges[state] : EdgeRow(); }
  std::size_t worked_bit(std::size_t leaf) const { return leaf; }
  std::size_t ended_bit(std::size_t leaf) const { return leaves + leaf; }
  std::size_t held_bit(std::size_t child) const { return 2 * leaves + child; }
  std::size_t owed_bit(std::size_t property) const { return 2 * leaves + held + property; }
  bool has(const Edge& edge, std::size_t bit) const {
    return LabelTable::has(labels[edge.label], bit);
  }
};

// Of each state: some way leads from it to an end, or to a state that was not looked at.
std::vector<bool> can_end(const Graph& graph);

// Edges that a cycle may use.
using EdgeFilter = std::function<bool(const Edge&)>;

// A cycle that is fair: no activation of a leaf gets ticks for ever without an end. Empty: there
// is none. In order, from a state of it that a search finds first; the last edge leads back to it.
struct CycleStep {
  StateId from;
  Edge edge;
};
std::vector<CycleStep> fair_cycle(const Graph& graph, const EdgeFilter& filter = {});
// The same, fair or not, if there is any.
std::vector<CycleStep> any_cycle(const Graph& graph, const EdgeFilter& filter);

// The states to which some way leads from this one, which is one of them.
std::vector<bool> reachable_from(const Graph& graph, StateId from);

// Whether some cycle has an edge like this.
bool recurs(const Graph& graph, const EdgeFilter& is_wanted);

// How many ticks in a row may have this bit: nothing if there is no end, for some leaf may work
// as long as it likes meanwhile. Ask fair_cycle before.
struct LongestRow {
  bool is_endless = false;
  std::uint64_t ticks = 0;
};
LongestRow longest_row(const Graph& graph, std::size_t bit);

// From `from` the shortest way to a state for which `is_goal`, over the edges of the graph.
std::vector<CycleStep> shortest_way(const Graph& graph, StateId from,
                                    const std::vector<bool>& is_goal);

}  // namespace lockstep::host
