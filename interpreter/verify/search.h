// Ticks a tree from every state that it can reach with every answer that its leaves may give,
// breadth first: what is found first is found by a shortest path.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "verify/expansion.h"
#include "verify/graph.h"

namespace lockstep::host {

struct Occurrence {
  StateId from = kNoState;               // the state before the tick
  std::uint32_t ticks = 0;               // of a run until then, this one too
  std::vector<LeafAnswer> answers = {};  // of it
};

struct SearchResult {
  explicit SearchResult(const Tree& tree) : coverage(tree) {}

  SearchEnd end = SearchEnd::Complete;
  std::string note;  // of Values: which entry
  int signal = 0;
  Symmetry symmetry;
  bool rising_answers = true, joins = true;  // as in the limits, and so are the next
  std::uint64_t few_root_ticks = 0, few_ticks = 0;
  StateStore store;
  std::unique_ptr<TimeLimit> time_limit = std::make_unique<TimeLimit>();  // of both graphs
  std::vector<StateId> depths;  // the first state of each depth
  // How many states were known before each of these rows of states was looked at.
  static constexpr StateId kStatesOfRow = 64;
  std::vector<StateId> known;
  Graph graph;
  std::unique_ptr<Graph> cycles;  // see CycleGraph
  SearchCoverage coverage;
  std::uint64_t transitions = 0;
  std::uint64_t root_ticks = 0;  // of them all
  Nanoseconds took{0};
  std::array<std::optional<Occurrence>, kStatuses.size()> results = {};  // the first of each
  std::map<NodeIndex, std::pair<std::string, Occurrence>> faults = {};   // the first of each node
  std::optional<std::pair<std::string, Occurrence>> broken = {};         // contract of the leaves
  // Barriers that were passed before all had reached them; likewise.
  std::map<NodeIndex, std::pair<std::string, Occurrence>> passed = {};
  // Actions with commit that may be done again after a cut; likewise.
  std::map<NodeIndex, Occurrence> repeated = {};
  std::map<std::size_t, Occurrence> violated = {};  // properties, by their place

  // All states were looked at, as far as the store can tell.
  bool is_complete() const { return end == SearchEnd::Complete; }
  // For sure.
  bool is_proof() const { return is_complete() && !store.keeps_hashes(); }
  std::uint32_t depth_of(StateId state) const;
  // So many ticks were looked at with all behaviors.
  std::uint32_t complete_depth() const;
  // The states from the first to this one, each found by a tick from the one before it.
  std::vector<StateId> path_to(StateId state) const;
  // The labels of its edges say all that matters of cycles. It has at least the edges of those.
  const Graph& graph_of_cycles() const { return cycles == nullptr ? graph : *cycles; }
  std::size_t memory() const;

 private:
  StateId found_from(StateId state) const;
};

SearchResult search(const Tree& tree, const LeafModels& models,
                    std::span<const Property> properties, double rate, const SearchLimits& limits);

}  // namespace lockstep::host
