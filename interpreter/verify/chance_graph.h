// All that a tree may do with the chances of its leaves, as a Markov decision process: from each
// state a tick, in which some answers are chosen and others come by chance. Equal parts of ticks
// are there once. Nothing is left out for symmetry, since it counts how likely each answer is.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "verify/label_table.h"
#include "verify/search_limits.h"
#include "verify/stepper.h"

namespace lockstep::host {

using Vertex = StateId;

// Vertices of which some choose where to go on, and others go on by chance.
class DecisionProcess {
 public:
  struct Target {
    Vertex to = 0;
    double chance = 0;  // 0: it may be chosen
  };

  Vertex add(std::span<const Target> targets, bool is_by_chance);
  // Of a vertex that was added with one.
  void set_target(Vertex vertex, Vertex to) { targets_[first_[vertex]].to = to; }

  std::size_t states() const { return first_.size() - 1; }
  std::span<const Target> edges_of(Vertex vertex) const {
    return std::span(targets_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }
  bool is_by_chance(Vertex vertex) const { return is_by_chance_[vertex]; }
  std::size_t memory() const {
    return targets_.capacity() * sizeof targets_[0] + first_.capacity() * sizeof first_[0];
  }

 private:
  std::vector<Target> targets_;
  std::vector<std::size_t> first_{0};
  std::vector<bool> is_by_chance_;
};

struct ChanceGraph {
  // A vertex at the end of a tick: the run ends there, or goes on.
  struct TickEnd {
    Vertex vertex = 0;
    std::optional<Status> result = {};  // of a run that ends without a fault
    StateId to = kNoState;              // where it goes on; kNoState: it ends
    std::uint32_t label = 0;
    std::vector<std::uint32_t> violated = {};  // properties, by their place

    bool has_fault() const { return to == kNoState && !result; }
  };

  DecisionProcess process;
  std::vector<TickEnd> ends;
  Vertex first = 0;    // where a run begins
  Vertex unknown = 0;  // anything may come: a limit has ended the search before it
  std::size_t states = 0, looked_at = 0;
  std::uint64_t ticks = 0;
  LabelTable labels;  // of ticks: what leaves did in them, and what properties wait for
  LabelShape shape;
  SearchEnd end = SearchEnd::Complete;
  Nanoseconds took{0};
};

ChanceGraph explore_chances(const Tree& tree, const LeafModels& models,
                            std::span<const Property> properties, double rate,
                            const SearchLimits& limits);

}  // namespace lockstep::host
