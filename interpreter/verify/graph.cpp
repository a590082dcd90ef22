#include "verify/graph.h"

#include <algorithm>
#include <functional>
#include <unordered_map>

namespace lockstep::host {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

std::size_t all_states(const Graph& graph) {
  return graph.ends.size();
}

std::vector<StateId> expanded_states(const Graph& graph) {
  std::vector<StateId> states(graph.expanded());
  for (StateId i = 0; i < states.size(); ++i) states[i] = i;
  return states;
}

// Tarjan's algorithm without recursion, of the whole graph or of some states again and again: no
// two components have the same number, and one has a smaller number than those that lead to it.
class Components {
 public:
  explicit Components(const Graph& graph)
      : graph_(graph),
        of_(all_states(graph), kNone),
        index_(all_states(graph), kNone),
        low_(all_states(graph)) {}

  std::uint32_t of(StateId state) const { return of_[state]; }
  std::uint32_t count() const { return count_; }

  // Of these states, over the edges that `uses` says, which do not lead out of them.
  template <class Uses>
  void find(const std::vector<StateId>& states, const Uses& uses) {
    for (const StateId state : states) of_[state] = index_[state] = kNone;
    for (const StateId state : states) {
      if (index_[state] == kNone) visit(state, uses);
    }
  }

  // These states, component after component: those that one leads to come before it.
  std::vector<StateId> in_order(const std::vector<StateId>& states) const {
    std::vector<std::uint32_t> begins(count_ + 1);
    for (const StateId state : states) ++begins[of_[state] + 1];
    for (std::uint32_t i = 0; i < count_; ++i) begins[i + 1] += begins[i];
    std::vector<StateId> order(states.size());
    for (const StateId state : states) order[begins[of_[state]]++] = state;
    return order;
  }

  // Those of the last call in which an edge goes from one state to another.
  template <class Uses>
  std::vector<std::vector<StateId>> with_cycles(const std::vector<StateId>& states,
                                                const Uses& uses) const {
    std::vector<std::vector<StateId>> found;
    std::unordered_map<std::uint32_t, std::size_t> places;
    for (const StateId state : states) {
      for (const Edge& edge : graph_.edges_of(state)) {
        if (of_[edge.to] != of_[state] || !uses(state, edge)) continue;
        places.try_emplace(of_[state], places.size());
        break;
      }
    }
    found.resize(places.size());
    for (const StateId state : states) {
      if (const auto it = places.find(of_[state]); it != places.end()) {
        found[it->second].push_back(state);
      }
    }
    return found;
  }

 private:
  struct Frame {
    StateId state;
    EdgeRow::Iterator next;
  };

  template <class Uses>
  void visit(StateId root, const Uses& uses) {
    enter(root);
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      const StateId state = frame.state;
      if (frame.next == std::default_sentinel) {
        frames_.pop_back();
        if (low_[state] == index_[state]) close(state);
        if (!frames_.empty()) {
          low_[frames_.back().state] = std::min(low_[frames_.back().state], low_[state]);
        }
        continue;
      }
      const Edge edge = *frame.next;
      ++frame.next;
      if (!uses(state, edge)) continue;
      if (index_[edge.to] == kNone) {
        enter(edge.to);
      } else if (of_[edge.to] == kNone) {
        low_[state] = std::min(low_[state], index_[edge.to]);
      }
    }
  }

  void enter(StateId state) {
    index_[state] = low_[state] = next_++;
    stack_.push_back(state);
    frames_.push_back({state, graph_.edges_of(state).begin()});
  }

  void close(StateId root) {
    StateId state = kNoState;
    do {
      state = stack_.back();
      stack_.pop_back();
      of_[state] = count_;
    } while (state != root);
    ++count_;
  }

  const Graph& graph_;
  std::vector<std::uint32_t> of_, index_, low_;
  std::vector<StateId> stack_;
  std::vector<Frame> frames_;
  std::uint32_t next_ = 0, count_ = 0;
};

// A way over some edges, breadth first.
class Way {
 public:
  using Uses = std::function<bool(StateId from, const Edge&)>;
  using Goal = std::function<bool(StateId from, const Edge&)>;

  Way(const Graph& graph, Uses uses) : graph_(graph), uses_(std::move(uses)) {}

  // The last step is the first that is a goal.
  std::vector<CycleStep> find(StateId from, const Goal& is_goal) const {
    std::vector<CycleStep> queue;     // each edge that was taken
    std::vector<std::size_t> before;  // of each: the one before it; itself: none
    std::vector<bool> seen(all_states(graph_));
    seen[from] = true;
    const auto expand = [&](StateId state, std::size_t came_by) {
      for (const Edge& edge : graph_.edges_of(state)) {
        if (!uses_(state, edge)) continue;
        const bool goal = is_goal(state, edge);
        if (!goal && seen[edge.to]) continue;
        seen[edge.to] = true;
        before.push_back(came_by == kStart ? queue.size() : came_by);
        queue.push_back({state, edge});
        if (goal) return true;
      }
      return false;
    };
    bool found = expand(from, kStart);
    for (std::size_t at = 0; !found && at < queue.size(); ++at)
      found = expand(queue[at].edge.to, at);
    if (!found) return {};
    std::vector<CycleStep> way;
    for (std::size_t at = queue.size() - 1;; at = before[at]) {
      way.push_back(queue[at]);
      if (before[at] == at) break;
    }
    std::ranges::reverse(way);
    return way;
  }

 private:
  static constexpr std::size_t kStart = static_cast<std::size_t>(-1);
  const Graph& graph_;
  const Uses uses_;
};

// Finds a fair cycle in a component, by leaving out the leaves that only work (Streett's
// condition: who works again and again, ends again and again).
class FairCycle {
 public:
  enum class Fairness : bool { Needed, Ignored };
  FairCycle(const Graph& graph, const EdgeFilter& filter, Fairness fairness)
      : graph_(graph),
        filter_(filter),
        fairness_(fairness),
        components_(graph),
        set_(all_states(graph), kNone) {}

  std::vector<CycleStep> find() { return find(expanded_states(graph_), {}); }

 private:
  using Leaves = std::vector<std::size_t>;

  bool uses(const Edge& edge, const Leaves& without) const {
    if (filter_ && !filter_(edge)) return false;
    return std::ranges::none_of(
        without, [&](std::size_t leaf) { return graph_.has(edge, graph_.worked_bit(leaf)); });
  }

  std::vector<CycleStep> find(const std::vector<StateId>& states, const Leaves& without) {
    const std::uint32_t set = sets_++;
    for (const StateId state : states) set_[state] = set;
    const auto inside = [&](StateId, const Edge& edge) {
      return set_[edge.to] == set && uses(edge, without);
    };
    components_.find(states, inside);
    auto found = components_.with_cycles(states, inside);
    // The ones that a search finds first, first.
    std::ranges::sort(found, {}, [](const auto& it) { return std::ranges::min(it); });
    for (const auto& component : found) {
      const std::uint32_t number = components_.of(component.front());
      const auto within = [&](StateId from, const Edge& edge) {
        return components_.of(from) == number && components_.of(edge.to) == number &&
               uses(edge, without);
      };
      Leaves more = without;
      if (!add_those_that_only_work(component, within, more)) return walk(component, within);
      if (auto cycle = find(component, more); !cycle.empty()) return cycle;
    }
    return {};
  }

  template <class Within>
  bool add_those_that_only_work(const std::vector<StateId>& component, const Within& within,
                                Leaves& without) const {
    if (fairness_ == Fairness::Ignored) return false;
    std::vector<std::byte> all(graph_.labels.size() == 0 ? 0 : graph_.labels[0].size());
    for (const StateId state : component) {
      for (const Edge& edge : graph_.edges_of(state)) {
        if (!within(state, edge)) continue;
        const auto bits = graph_.labels[edge.label];
        for (std::size_t i = 0; i < all.size(); ++i) all[i] |= bits[i];
      }
    }
    const std::size_t before = without.size();
    for (std::size_t leaf = 0; leaf < graph_.leaves; ++leaf) {
      if (!LabelTable::has(all, graph_.worked_bit(leaf))) continue;
      if (!LabelTable::has(all, graph_.ended_bit(leaf))) without.push_back(leaf);
    }
    return without.size() != before;
  }

  // All of the component is fair. A short cycle: from its first state back to it, by way of an end
  // of each leaf that works on the way.
  std::vector<CycleStep> walk(const std::vector<StateId>& component,
                              const Way::Uses& within) const {
    const StateId start = std::ranges::min(component);
    const Way way(graph_, within);
    std::vector<CycleStep> cycle;
    std::vector<bool> ended(graph_.leaves);
    const auto take = [&](std::vector<CycleStep> steps) {
      for (CycleStep& step : steps) {
        for (std::size_t leaf = 0; leaf < graph_.leaves; ++leaf) {
          if (graph_.has(step.edge, graph_.ended_bit(leaf))) ended[leaf] = true;
        }
        cycle.push_back(step);
      }
    };
    const auto lacking = [&] {
      for (std::size_t leaf = 0; leaf < graph_.leaves; ++leaf) {
        if (fairness_ == Fairness::Ignored) break;
        const bool works = std::ranges::any_of(cycle, [&](const CycleStep& it) {
          return graph_.has(it.edge, graph_.worked_bit(leaf));
        });
        if (works && !ended[leaf]) return leaf;
      }
      return graph_.leaves;
    };
    take(way.find(start, [&](StateId, const Edge& edge) { return edge.to == start; }));
    // Not fair yet: it also goes where the leaf ends, and back.
    while (true) {
      const std::size_t leaf = lacking();
      if (leaf == graph_.leaves) return cycle;
      const StateId here = cycle.back().edge.to;
      take(way.find(here, [&](StateId, const Edge& edge) {
        return graph_.has(edge, graph_.ended_bit(leaf));
      }));
      if (const StateId there = cycle.back().edge.to; there != start) {
        take(way.find(there, [&](StateId, const Edge& edge) { return edge.to == start; }));
      }
    }
  }

  const Graph& graph_;
  const EdgeFilter& filter_;
  const Fairness fairness_;
  Components components_;
  std::vector<std::uint32_t> set_;  // of each state: the last set in which it was looked at
  std::uint32_t sets_ = 0;
};

}  // namespace

std::vector<bool> can_end(const Graph& graph) {
  const std::vector<StateId> states = expanded_states(graph);
  Components components(graph);
  components.find(states, [](StateId, const Edge&) { return true; });
  std::vector<bool> can = graph.ends;
  for (std::size_t state = graph.expanded(); state < can.size(); ++state) can[state] = true;
  // Of each component. Those that it leads to come before it.
  std::vector<bool> component_can(components.count());
  for (const StateId state : components.in_order(states)) {
    const auto leads_out = [&](const Edge& edge) {
      return can[edge.to] || component_can[components.of(edge.to)];
    };
    if (!component_can[components.of(state)]) {
      component_can[components.of(state)] =
          can[state] || std::ranges::any_of(graph.edges_of(state), leads_out);
    }
  }
  for (const StateId state : states) can[state] = component_can[components.of(state)];
  return can;
}

std::vector<CycleStep> fair_cycle(const Graph& graph, const EdgeFilter& filter) {
  return FairCycle(graph, filter, FairCycle::Fairness::Needed).find();
}

std::vector<CycleStep> any_cycle(const Graph& graph, const EdgeFilter& filter) {
  return FairCycle(graph, filter, FairCycle::Fairness::Ignored).find();
}

std::vector<bool> reachable_from(const Graph& graph, StateId from) {
  std::vector<bool> reached(all_states(graph));
  reached[from] = true;
  std::vector<StateId> queue{from};
  while (!queue.empty()) {
    const StateId state = queue.back();
    queue.pop_back();
    for (const Edge& edge : graph.edges_of(state)) {
      if (reached[edge.to]) continue;
      reached[edge.to] = true;
      queue.push_back(edge.to);
    }
  }
  return reached;
}

bool recurs(const Graph& graph, const EdgeFilter& is_wanted) {
  const std::vector<StateId> states = expanded_states(graph);
  Components components(graph);
  components.find(states, [](StateId, const Edge&) { return true; });
  return std::ranges::any_of(states, [&](StateId state) {
    return std::ranges::any_of(graph.edges_of(state), [&](const Edge& edge) {
      return components.of(state) == components.of(edge.to) && is_wanted(edge);
    });
  });
}

LongestRow longest_row(const Graph& graph, std::size_t bit) {
  const std::vector<StateId> states = expanded_states(graph);
  const auto uses = [&](StateId, const Edge& edge) { return graph.has(edge, bit); };
  Components components(graph);
  components.find(states, uses);
  if (!components.with_cycles(states, uses).empty()) return {.is_endless = true};
  // Without cycles each state is a component.
  std::vector<std::uint32_t> longest(all_states(graph));
  LongestRow row;
  for (const StateId state : components.in_order(states)) {
    for (const Edge& edge : graph.edges_of(state)) {
      if (uses(state, edge)) longest[state] = std::max(longest[state], longest[edge.to] + 1);
    }
    row.ticks = std::max<std::uint64_t>(row.ticks, longest[state]);
  }
  return row;
}

std::vector<CycleStep> shortest_way(const Graph& graph, StateId from,
                                    const std::vector<bool>& is_goal) {
  const Way way(graph, [](StateId, const Edge&) { return true; });
  return way.find(from, [&](StateId, const Edge& edge) { return bool(is_goal[edge.to]); });
}

}  // namespace lockstep::host
