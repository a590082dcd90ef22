#include "verify/holds.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "verify/fair_cycle.h"

namespace lockstep::host {
namespace {

constexpr std::uint32_t kNoLeaf = 0xffffffff;

}  // namespace

FollowedChildren::FollowedChildren(const Graph& graph, const std::vector<std::size_t>& children)
    : graph_(graph), children_(children), moving_(children.size()) {
  for (std::size_t i = 0; i < graph.shape.moving_held.size(); ++i) {
    places_.push_back(static_cast<std::size_t>(
        std::ranges::find(children, graph.shape.moving_held[i]) - children.begin()));
    if (places_[i] < children.size()) moving_[places_[i]] = i;
  }
  leaves_.assign(children.size(), kNoLeaf);
  for (std::uint32_t leaf = 0; leaf < graph.shape.held_of_leaf.size(); ++leaf) {
    const LabelShape::Place held = graph.shape.held_of_leaf[leaf];
    if (held != LabelShape::kNowhere && places_[held] < children.size()) {
      leaves_[places_[held]] = leaf;
    }
  }
}

// The child is held in the tick if it is the one at the place that it chooses.
template <class F>
void FollowedChildren::for_each(const Edge& edge, std::size_t child, const F& call) const {
  const auto visit = [&](std::size_t as, Swap swap) {
    if (!graph_.has(edge, graph_.shape.held_bit(children_[as]))) return;
    const std::size_t next = places_[graph_.held_after(edge, moving_[as])];
    call(static_cast<StateId>(edge.to * children_.size() + next), swap);
  };
  const std::size_t leaf = leaves_[child];
  if (leaf == kNoLeaf) return visit(child, {});
  graph_.for_each_equal(edge, leaf, [&](std::size_t equal) {
    visit(places_[graph_.shape.held_of_leaf[equal]], {leaf, equal});
  });
}

Graph FollowedChildren::graph() const {
  const std::size_t count = children_.size();
  if (graph_.states() > std::numeric_limits<StateId>::max() / count) {
    throw std::length_error("too many states to follow each child");
  }
  Graph followed{.edges = {}, .ends = {}, .labels = graph_.labels, .shape = graph_.shape};
  followed.ends.resize(graph_.states() * count);
  std::vector<Edge> edges;
  for (StateId state = 0; state < graph_.expanded(); ++state) {
    for (std::size_t child = 0; child < count; ++child) {
      edges.clear();
      for (const Edge& edge : graph_.edges_of(state)) {
        for_each(edge, child, [&](StateId to, Swap swap) {
          edges.push_back({to, followed.labels.add(label(edge, child, swap))});
        });
      }
      std::ranges::sort(edges);
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      followed.edges.add(edges);
    }
  }
  return followed;
}

// The child that is followed is not one of its equals any more.
std::vector<std::byte> FollowedChildren::label(const Edge& edge, std::size_t child,
                                               Swap swap) const {
  const auto label = graph_.labels[edge.label];
  if (leaves_[child] == kNoLeaf) return {label.begin(), label.end()};
  return graph_.shape.swapped(label, swap.one, swap.other);
}

CycleStep FollowedChildren::step(const Graph& followed, const CycleStep& step) const {
  const std::size_t count = children_.size(), child = step.from % count;
  const auto wanted = followed.labels[step.edge.label];
  CycleStep found{static_cast<StateId>(step.from / count), {}, step.swaps};
  bool is_found = false;
  for (const Edge& edge : graph_.edges_of(found.from)) {
    for_each(edge, child, [&](StateId to, Swap swap) {
      if (is_found || to != step.edge.to) return;
      if (!std::ranges::equal(label(edge, child, swap), wanted)) return;
      is_found = true;
      found.edge = edge;
      found.swaps[1] = swap;
    });
    if (is_found) return found;
  }
  throw std::logic_error("an edge of a child that is followed is not there any more");
}

Holds::Holds(const Graph& graph, std::vector<std::size_t> children)
    : graph_(graph), children_(std::move(children)), following_(graph_, children_) {
  if (children_.size() > 1) followed_ = following_.graph();
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
    if (count > 1) step = following_.step(followed_, step);
  }
  return endless;
}

}  // namespace lockstep::host
