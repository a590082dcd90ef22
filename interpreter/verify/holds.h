// For how long a child may be held. A child that may move is followed from place to place.
#pragma once

#include <optional>
#include <vector>

#include "verify/graph.h"

namespace lockstep::host {

class Holds {
 public:
  // `graph` must outlive this. `children`, of LabelShape::held: one, or all that may come to its
  // place.
  Holds(const Graph& graph, std::vector<std::size_t> children);

  // How many ticks in a row: nothing if there is no end.
  std::optional<std::uint64_t> longest() const;
  // A fair cycle in which one is held in each tick, and which one that is when it begins.
  struct Endless {
    std::size_t child;
    std::vector<CycleStep> cycle;
  };
  std::optional<Endless> for_ever() const;

 private:
  EdgeFilter filter() const;

  const Graph& graph_;
  const std::vector<std::size_t> children_;
  // With several children: a state for each state and each of them, and the edges that hold it.
  Graph followed_;
};

}  // namespace lockstep::host
