#include "verify/holds.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "verify/components.h"
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
    const MovingPlace held = graph.shape.held_of_leaf[leaf];
    if (held != LabelShape::kNowhere && places_[held] < children.size()) {
      leaves_[places_[held]] = leaf;
    }
  }
}

bool FollowedChildren::is_first(const Label& equals, std::size_t child) const {
  return leaves_[child] == kNoLeaf || equals.after[leaves_[child]] == leaves_[child];
}

// Two that differ in nothing but their places count once.
void FollowedChildren::choose(const Tick& tick, std::size_t child,
                              std::vector<Choice>& choices) const {
  const LabelShape& shape = graph_.shape;
  choices.clear();
  const auto child_behind = [&](std::size_t as) {
    const std::size_t leaves = shape.moving_leaves.size();
    return places_[tick.label.after[leaves + moving_[as]] - leaves];
  };
  const auto is_held = [&](std::size_t as) {
    return tick.label.has(shape.held_bit(children_[as]));
  };
  const std::size_t first = leaves_[child];
  if (first == kNoLeaf) {
    if (is_held(child)) choices.push_back({child_behind(child), {}, {}});
    return;
  }
  std::vector<std::array<std::size_t, 3>> seen;
  for_each_equal(tick.before, first, shape.moving_leaves.size(), [&](std::size_t leaf) {
    const std::size_t as = places_[shape.held_of_leaf[leaf]];
    if (!is_held(as)) return;
    const std::size_t there = tick.label.after[leaf];
    std::size_t to = there;
    while (tick.after.after[to] != to) to = tick.after.after[to];
    const std::array<std::size_t, 3> now{
        to, tick.label.has(shape.worked_bit(shape.moving_leaves[leaf])) ? 1u : 0u,
        tick.label.has(shape.ended_bit(shape.moving_leaves[leaf])) ? 1u : 0u};
    if (std::ranges::find(seen, now) != seen.end()) return;
    seen.push_back(now);
    choices.push_back({places_[shape.held_of_leaf[to]], {first, leaf}, {there, to}});
  });
}

void FollowedChildren::read_after(const Edge& edge, Tick& tick) const {
  graph_.read(edge, tick.label);
  graph_.read_equals(edge.to, tick.after);
}

Label FollowedChildren::label(const Tick& tick, const Choice& choice) const {
  Label label = tick.label;
  graph_.shape.exchange_before(label, choice.before.one, choice.before.other);
  graph_.shape.exchange_after(label, choice.after.one, choice.after.other);
  return label;
}

Graph FollowedChildren::graph(Labels labels, const Wanted& is_wanted) const {
  const std::size_t count = children_.size();
  if (graph_.states() > std::numeric_limits<StateId>::max() / count) {
    throw std::length_error("too many states to follow each child");
  }
  Graph followed{.edges = {}, .ends = {}, .labels = {}, .shape = graph_.shape};
  followed.ends.resize(graph_.states() * count);
  Tick tick;
  std::vector<Choice> choices;
  std::vector<std::vector<Edge>> edges(count);
  for (StateId state = 0; state < graph_.expanded(); ++state) {
    graph_.read_equals(state, tick.before);
    for (const Edge& edge : graph_.edges_of(state)) {
      read_after(edge, tick);
      for (std::size_t child = 0; child < count; ++child) {
        if (!is_first(tick.before, child)) continue;
        choose(tick, child, choices);
        for (const Choice& it : choices) {
          const auto to = static_cast<StateId>(edge.to * count + it.child);
          if (!is_wanted(static_cast<StateId>(state * count + child), to)) continue;
          const bool has_label = labels == Labels::All;
          edges[child].push_back({to, has_label ? followed.labels.add(label(tick, it)) : 0});
        }
      }
    }
    for (std::size_t child = 0; child < count; ++child) {
      std::ranges::sort(edges[child]);
      edges[child].erase(std::unique(edges[child].begin(), edges[child].end()), edges[child].end());
      followed.edges.add(edges[child]);
      edges[child].clear();
      if (labels == Labels::All) {
        followed.equals.push_back(followed.labels.add(others(tick.before, child)));
      }
    }
  }
  return followed;
}

// The child that is followed is not one of its equals any more.
Label FollowedChildren::others(const Label& equals, std::size_t child) const {
  Label others = equals;
  for (std::size_t i = 0; leaves_[child] != kNoLeaf && i < graph_.shape.moving_leaves.size(); ++i) {
    if (others.after[i] == leaves_[child]) others.after[i] = static_cast<MovingPlace>(i);
  }
  return others;
}

CycleStep FollowedChildren::step(const Graph& followed, const CycleStep& step) const {
  const std::size_t count = children_.size(), child = step.from % count;
  Label wanted;
  followed.read(step.edge, wanted);
  const auto from = static_cast<StateId>(step.from / count);
  Tick tick;
  graph_.read_equals(from, tick.before);
  std::vector<Choice> choices;
  for (const Edge& edge : graph_.edges_of(from)) {
    read_after(edge, tick);
    choose(tick, child, choices);
    for (const Choice& it : choices) {
      if (edge.to * count + it.child != step.edge.to || label(tick, it) != wanted) continue;
      return {from, edge, {step.swaps[0], it.before}, it.after};
    }
  }
  throw std::logic_error("an edge of a child that is followed is not there any more");
}

Holds::Holds(const Graph& graph, std::vector<std::size_t> children)
    : graph_(graph), children_(std::move(children)), following_(graph_, children_) {
  if (children_.size() > 1) {
    followed_ =
        following_.graph(FollowedChildren::Labels::None, [](StateId, StateId) { return true; });
  }
}

EdgeFilter Holds::filter() const {
  if (children_.size() > 1) return [](const Edge&) { return true; };
  // Many edges have one label.
  std::vector<bool> holds;
  for (std::uint32_t label = 0; label < graph_.labels.size(); ++label) {
    holds.push_back(graph_.labels.has(label, graph_.shape.held_bit(children_.front())));
  }
  return [holds = std::move(holds)](const Edge& edge) { return bool(holds[edge.label]); };
}

std::optional<std::uint64_t> Holds::longest() const {
  return longest_row(children_.size() > 1 ? followed_ : graph_, filter());
}

std::optional<Holds::Endless> Holds::for_ever() const {
  const std::size_t count = children_.size();
  Endless endless{children_.front(), {}};
  if (count == 1) {
    endless.cycle = fair_cycle(graph_, filter());
    return endless.cycle.empty() ? std::nullopt : std::optional(std::move(endless));
  }
  Components components(followed_);
  std::vector<StateId> states(followed_.expanded());
  std::iota(states.begin(), states.end(), StateId{0});
  components.find(states, [](StateId, const Edge&) { return true; });
  // Only edges inside of one are in a cycle.
  const Graph labelled = following_.graph(
      FollowedChildren::Labels::All,
      [&](StateId from, StateId to) { return components.of(from) == components.of(to); });
  endless.cycle = fair_cycle(labelled, filter());
  if (endless.cycle.empty()) return std::nullopt;
  endless.child = children_[endless.cycle.front().from % count];
  for (CycleStep& step : endless.cycle) step = following_.step(labelled, step);
  return endless;
}

}  // namespace lockstep::host
