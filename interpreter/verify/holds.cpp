#include "verify/holds.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "verify/fair_cycle.h"

namespace lockstep::host {
namespace {

// The place among `children` of each child that may move, by its place among those.
std::vector<std::size_t> places_of(const LabelShape& shape,
                                   const std::vector<std::size_t>& children) {
  std::vector<std::size_t> places;
  for (const std::uint32_t child : shape.moving_held) {
    places.push_back(
        static_cast<std::size_t>(std::ranges::find(children, child) - children.begin()));
  }
  return places;
}

Graph follow(const Graph& graph, const std::vector<std::size_t>& children) {
  const std::vector<std::size_t> places = places_of(graph.shape, children);
  const std::size_t count = children.size();
  if (graph.states() > std::numeric_limits<StateId>::max() / count) {
    throw std::length_error("too many states to follow each child");
  }
  Graph followed{.edges = {}, .ends = {}, .labels = graph.labels, .shape = graph.shape};
  followed.ends.resize(graph.states() * count);
  std::vector<std::size_t> moving(count);  // of each child: its place among those that may move
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] < count) moving[places[i]] = i;
  }
  std::vector<Edge> edges;
  for (StateId state = 0; state < graph.expanded(); ++state) {
    for (std::size_t child = 0; child < count; ++child) {
      edges.clear();
      for (const Edge& edge : graph.edges_of(state)) {
        if (!graph.has(edge, graph.shape.held_bit(children[child]))) continue;
        const std::size_t next = places[graph.held_after(edge, moving[child])];
        edges.push_back({static_cast<StateId>(edge.to * count + next), edge.label});
      }
      std::ranges::sort(edges);
      followed.edges.add(edges);
    }
  }
  return followed;
}

}  // namespace

Holds::Holds(const Graph& graph, std::vector<std::size_t> children)
    : graph_(graph), children_(std::move(children)) {
  if (children_.size() > 1) followed_ = follow(graph, children_);
}

EdgeFilter Holds::filter() const {
  if (children_.size() > 1) return [](const Edge&) { return true; };
  const std::size_t bit = graph_.shape.held_bit(children_.front());
  return [this, bit](const Edge& edge) { return graph_.has(edge, bit); };
}

std::optional<std::uint64_t> Holds::longest() const {
  return longest_row(children_.size() > 1 ? followed_ : graph_, filter());
}

std::optional<Holds::Endless> Holds::for_ever() const {
  const std::size_t count = children_.size();
  Endless endless{children_.front(), fair_cycle(count > 1 ? followed_ : graph_, filter())};
  if (endless.cycle.empty()) return std::nullopt;
  endless.child = children_[endless.cycle.front().from % count];
  for (CycleStep& step : endless.cycle) {
    step.from = static_cast<StateId>(step.from / count);
    step.edge.to = static_cast<StateId>(step.edge.to / count);
  }
  return endless;
}

}  // namespace lockstep::host
