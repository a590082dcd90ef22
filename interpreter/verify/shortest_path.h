// The shortest path over some edges of a graph, breadth first. It can also lead to what an edge
// does with one leaf, which the edges before it may have moved to other places.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "verify/graph.h"

namespace lockstep::host {

// The places of a leaf that is followed: how many there are, between which of them it may choose
// before an edge, and where the edge moves it then.
struct FollowedLeaf {
  std::size_t places = 1;
  using Take = std::function<void(std::size_t place)>;
  std::function<void(StateId from, const Edge&, std::size_t place, const Take&)> choices = {};
  std::function<std::size_t(const Edge&, std::size_t place)> next = {};
};

class ShortestPath {
 public:
  using Uses = std::function<bool(StateId from, const Edge&)>;
  // `place`: of the leaf that is followed, before the edge.
  using Goal = std::function<bool(StateId from, const Edge&, std::size_t place)>;

  // The graph must outlive this.
  ShortestPath(const Graph& graph, Uses uses, FollowedLeaf followed = {})
      : graph_(graph), uses_(std::move(uses)), followed_(std::move(followed)) {}

  // The last step is the first that is a goal.
  std::vector<CycleStep> find(StateId from, const Goal& is_goal, std::size_t place = 0) const {
    std::vector<Taken> queue;
    std::vector<bool> seen(graph_.states() * followed_.places);
    seen[from * followed_.places + place] = true;
    // True: a goal is the last of the queue.
    const auto take = [&](const CycleStep& step, std::size_t here, std::size_t came_by) {
      const bool goal = is_goal(step.from, step.edge, here);
      const std::size_t there = followed_.next ? followed_.next(step.edge, here) : here;
      const std::size_t number = step.edge.to * followed_.places + there;
      if (!goal && seen[number]) return false;
      seen[number] = true;
      queue.push_back({step, there, came_by == kStart ? queue.size() : came_by});
      return goal;
    };
    const auto expand = [&](StateId state, std::size_t here, std::size_t came_by) {
      for (const Edge& edge : graph_.edges_of(state)) {
        if (!uses_(state, edge)) continue;
        bool goal = false;
        const auto take_from = [&](std::size_t chosen) {
          goal = goal || take({state, edge, {Swap{here, chosen}}}, chosen, came_by);
        };
        followed_.choices ? followed_.choices(state, edge, here, take_from) : take_from(here);
        if (goal) return true;
      }
      return false;
    };
    bool found = expand(from, place, kStart);
    for (std::size_t at = 0; !found && at < queue.size(); ++at) {
      found = expand(queue[at].step.edge.to, queue[at].place, at);
    }
    if (!found) return {};
    std::vector<CycleStep> path;
    for (std::size_t at = queue.size() - 1;; at = queue[at].before) {
      path.push_back(queue[at].step);
      if (queue[at].before == at) break;
    }
    std::ranges::reverse(path);
    return path;
  }

 private:
  static constexpr std::size_t kStart = static_cast<std::size_t>(-1);
  struct Taken {
    CycleStep step;
    std::size_t place;   // after it
    std::size_t before;  // the one before it, by number; of the first itself
  };
  const Graph& graph_;
  const Uses uses_;
  const FollowedLeaf followed_;
};

}  // namespace lockstep::host
