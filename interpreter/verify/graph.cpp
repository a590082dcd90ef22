#include "verify/graph.h"

#include <algorithm>
#include <numeric>

#include "verify/components.h"
#include "verify/shortest_path.h"

namespace lockstep::host {
namespace {

std::vector<StateId> expanded_states(const Graph& graph) {
  std::vector<StateId> states(graph.expanded());
  std::iota(states.begin(), states.end(), StateId{0});
  return states;
}

}  // namespace

std::vector<bool> can_end(const Graph& graph) {
  const std::vector<StateId> states = expanded_states(graph);
  Components components(graph);
  components.find(states, [](StateId, const Edge&) { return true; });
  std::vector<bool> can = graph.ends;
  for (std::size_t state = graph.expanded(); state < can.size(); ++state) can[state] = true;
  // A component comes behind those that it leads to.
  std::vector<bool> component_can(components.count());
  for (const StateId state : components.in_order(states)) {
    const auto leads_out = [&](const Edge& edge) {
      return !graph.is_cut(state, edge) && (can[edge.to] || component_can[components.of(edge.to)]);
    };
    if (!component_can[components.of(state)]) {
      component_can[components.of(state)] =
          can[state] || std::ranges::any_of(graph.edges_of(state), leads_out);
    }
  }
  for (const StateId state : states) can[state] = component_can[components.of(state)];
  return can;
}

std::vector<bool> reachable_from(const Graph& graph, StateId from) {
  std::vector<bool> reached(graph.states());
  reached[from] = true;
  std::vector<StateId> queue{from};
  while (!queue.empty()) {
    const StateId state = queue.back();
    queue.pop_back();
    for (const Edge& edge : graph.edges_of(state)) {
      if (reached[edge.to] || graph.is_cut(state, edge)) continue;
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

std::optional<std::uint64_t> longest_row(const Graph& graph, const LabelFilter& is_wanted) {
  const std::vector<StateId> states = expanded_states(graph);
  const auto uses = [&](StateId, const Edge& edge) { return is_wanted(edge.label); };
  Components components(graph);
  components.find(states, uses);
  if (!components.with_cycles(states, uses).empty()) return std::nullopt;
  // Without cycles each state is a component.
  std::vector<std::uint32_t> longest(graph.states());
  std::uint32_t most = 0;
  for (const StateId state : components.in_order(states)) {
    const EdgeRow edges = graph.edges_of(state);
    if (const auto end = edges.label_of_end(); end && is_wanted(*end)) longest[state] = 1;
    for (const Edge& edge : edges) {
      if (is_wanted(edge.label)) longest[state] = std::max(longest[state], longest[edge.to] + 1);
    }
    most = std::max(most, longest[state]);
  }
  return most;
}

std::vector<CycleStep> shortest_path(const Graph& graph, StateId from,
                                     const std::vector<bool>& is_goal) {
  const ShortestPath path(
      graph, [&](StateId state, const Edge& edge) { return !graph.is_cut(state, edge); });
  return path.find(from,
                   [&](StateId, const Edge& edge, std::size_t) { return bool(is_goal[edge.to]); });
}

}  // namespace lockstep::host
