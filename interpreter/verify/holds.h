// For how long a child may be held. A child that may move is followed from place to place.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "verify/graph.h"

namespace lockstep::host {

// Children that may come to each other's places, followed: a state for each state and each of them,
// and the edges that hold it. Of those in equal states, the first stands for all.
class FollowedChildren {
 public:
  // Both must outlive this.
  FollowedChildren(const Graph& graph, const std::vector<std::size_t>& children);

  // Whether the edges say more than where they go: only labels make a cycle fair.
  enum class Labels : bool { None, All };
  // Those of its edges that are wanted, by their ends.
  using Wanted = std::function<bool(StateId from, StateId to)>;
  Graph graph(Labels labels, const Wanted& is_wanted) const;
  // The step of the graph that is followed for one of that.
  CycleStep step(const Graph& followed, const CycleStep& step) const;

 private:
  // The child is held in a tick at the place of one of its equals, `before` the tick, and behind it
  // changes places with the first of its equals.
  struct Choice {
    std::size_t child;  // then
    Swap before, after;
    Label label = {};  // of the tick with these changes
  };
  // What a tick does, and what is equal before and after it.
  struct Tick {
    Label label, before, after;
  };
  void read_after(const Edge& edge, Tick& tick) const;
  template <class IsWanted>
  void choose(const Tick& tick, std::size_t child, Labels labels, const IsWanted& is_wanted,
              std::vector<Choice>& choices) const;
  Label label(const Tick& tick, const Choice& choice) const;
  bool is_held_at_end(StateId state, const Label& equals, std::size_t child) const;
  std::size_t place_of(std::size_t child) const {
    return graph_.shape.moving_leaves.size() + moving_[child];
  }
  std::size_t child_at(std::size_t place) const {
    return places_[place - graph_.shape.moving_leaves.size()];
  }
  bool is_first(const Label& equals, std::size_t child) const {
    return equals.after[place_of(child)] == place_of(child);
  }

  const Graph& graph_;
  const std::vector<std::size_t>& children_;
  std::vector<std::size_t> moving_;  // of each child: its place among those that may move
  std::vector<std::size_t> places_;  // of each that may move: its place among the children
};

class Holds {
 public:
  // Both graphs must outlive this. `children`, of LabelShape::held: one, or all that may come to
  // its place. The labels of `cycles` say all that matters of cycles.
  Holds(const Graph& graph, const Graph& cycles, std::vector<std::size_t> children);

  // How many ticks in a row: nothing if there is no end.
  std::optional<std::uint64_t> longest() const;
  // A fair cycle in which one is held in each tick, and which one that is when it begins.
  struct Endless {
    std::size_t child;
    std::vector<CycleStep> cycle;
  };
  std::optional<Endless> for_ever() const;

 private:
  LabelFilter filter(const Graph& graph) const;

  const Graph &graph_, &cycles_;
  const std::vector<std::size_t> children_;
  const FollowedChildren following_;
  Graph followed_;  // with several children; without labels
};

}  // namespace lockstep::host
