#include "verify/holds.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "verify/components.h"
#include "verify/fair_cycle.h"

namespace lockstep::host {
FollowedChildren::FollowedChildren(const Graph& graph, const std::vector<std::size_t>& children)
    : graph_(graph), children_(children), moving_(children.size()) {
  for (std::size_t i = 0; i < graph.shape.moving_held.size(); ++i) {
    places_.push_back(static_cast<std::size_t>(
        std::ranges::find(children, graph.shape.moving_held[i]) - children.begin()));
    if (places_[i] < children.size()) moving_[places_[i]] = i;
  }
}

// Two that differ in nothing but their places count once.
template <class IsWanted>
void FollowedChildren::choose(const Tick& tick, std::size_t child, Labels labels,
                              const IsWanted& is_wanted, std::vector<Choice>& choices) const {
  choices.clear();
  for_each_equal(tick.before, place_of(child), [&](std::size_t as) {
    if (!tick.label.has(graph_.shape.held_bit(children_[child_at(as)]))) return;
    const std::size_t there = tick.label.after[as];
    std::size_t to = there;
    while (tick.after.after[to] != to) to = tick.after.after[to];
    if (!is_wanted(child_at(to))) return;
    Choice it{child_at(to), {place_of(child), as}, {there, to}};
    if (labels == Labels::All) it.label = label(tick, it);
    const bool is_known = std::ranges::any_of(choices, [&](const Choice& other) {
      return other.child == it.child && other.label == it.label;
    });
    if (!is_known) choices.push_back(std::move(it));
  });
}

void FollowedChildren::read_after(const Edge& edge, Tick& tick) const {
  graph_.read(edge, tick.label);
  graph_.read_equals(edge.to, tick.after);
}

Label FollowedChildren::label(const Tick& tick, const Choice& choice) const {
  Label label = tick.label;
  graph_.shape.exchange_before(label, choice.before);
  graph_.shape.exchange_after(label, choice.after);
  return label;
}

Graph FollowedChildren::graph(Labels labels, const Wanted& is_wanted) const {
  const std::size_t count = children_.size();
  if (graph_.states() > std::numeric_limits<StateId>::max() / count) {
    throw std::length_error("too many states to follow each child");
  }
  Graph followed{.edges = {}, .ends = {}, .labels = {}, .shape = graph_.shape};
  followed.ends.resize(graph_.states() * count);
  followed.time_limit = graph_.time_limit;
  Tick tick;
  std::vector<Choice> choices;
  std::vector<std::vector<Edge>> edges(count);
  for (StateId state = 0; state < graph_.expanded(); ++state) {
    graph_.read_equals(state, tick.before);
    for (const Edge& edge : graph_.edges_of(state)) {
      read_after(edge, tick);
      for (std::size_t child = 0; child < count; ++child) {
        if (!is_first(tick.before, child)) continue;
        const auto number = [&](std::size_t to) {
          return static_cast<StateId>(edge.to * count + to);
        };
        const auto is_wanted_to = [&](std::size_t to) {
          return is_wanted(static_cast<StateId>(state * count + child), number(to));
        };
        choose(tick, child, labels, is_wanted_to, choices);
        for (const Choice& it : choices) {
          const bool has_label = labels == Labels::All;
          edges[child].push_back({number(it.child), has_label ? followed.labels.add(it.label) : 0});
        }
      }
    }
    for (std::size_t child = 0; child < count; ++child) {
      std::ranges::sort(edges[child]);
      edges[child].erase(std::unique(edges[child].begin(), edges[child].end()), edges[child].end());
      followed.edges.add(edges[child], is_held_at_end(state, tick.before, child)
                                           ? std::optional<std::uint32_t>(0)
                                           : std::nullopt);
      edges[child].clear();
      if (labels == Labels::All) {
        const Label equals = graph_.shape.equals_beside(tick.before, place_of(child));
        followed.equals.push_back(followed.labels.add(equals));
      }
    }
  }
  return followed;
}

// All places of its equals are looked at, so a child that is not the first counts as that one.
bool FollowedChildren::is_held_at_end(StateId state, const Label& equals, std::size_t child) const {
  const auto end = graph_.edges_of(state).label_of_end();
  bool is_held = false;
  for_each_equal(equals, place_of(child), [&](std::size_t as) {
    const std::size_t bit = graph_.shape.held_bit(children_[child_at(as)]);
    is_held = is_held || (end && graph_.labels.has(*end, bit));
  });
  return is_held;
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
    const auto is_wanted = [&](std::size_t to) { return edge.to * count + to == step.edge.to; };
    choose(tick, child, Labels::All, is_wanted, choices);
    for (const Choice& it : choices) {
      if (it.label == wanted) return {from, edge, {step.swaps[0], it.before}, it.after};
    }
  }
  throw std::logic_error("an edge of a child that is followed is not there any more");
}

Holds::Holds(const Graph& graph, const Graph& cycles, std::vector<std::size_t> children)
    : graph_(graph),
      cycles_(cycles),
      children_(std::move(children)),
      following_(graph_, children_) {
  if (children_.size() > 1) {
    followed_ =
        following_.graph(FollowedChildren::Labels::None, [](StateId, StateId) { return true; });
  }
}

LabelFilter Holds::filter(const Graph& graph) const {
  if (children_.size() > 1) return [](std::uint32_t) { return true; };
  // Many edges have one label.
  std::vector<bool> holds;
  for (std::uint32_t label = 0; label < graph.labels.size(); ++label) {
    holds.push_back(graph.labels.has(label, graph.shape.held_bit(children_.front())));
  }
  return [holds = std::move(holds)](std::uint32_t label) { return bool(holds[label]); };
}

std::optional<std::uint64_t> Holds::longest() const {
  return longest_row(children_.size() > 1 ? followed_ : graph_, filter(graph_));
}

std::optional<Holds::Endless> Holds::for_ever() const {
  const std::size_t count = children_.size();
  Endless endless{children_.front(), {}};
  if (count == 1) {
    endless.cycle = fair_cycle(
        cycles_, [holds = filter(cycles_)](const Edge& edge) { return holds(edge.label); });
    return endless.cycle.empty() ? std::nullopt : std::optional(std::move(endless));
  }
  Components components(followed_);
  std::vector<StateId> states(followed_.expanded());
  std::iota(states.begin(), states.end(), StateId{0});
  components.find(states, [](StateId, const Edge&) { return true; });
  // Only edges inside of one are in a cycle.
  const FollowedChildren following(cycles_, children_);
  const Graph labelled = following.graph(
      FollowedChildren::Labels::All,
      [&](StateId from, StateId to) { return components.of(from) == components.of(to); });
  endless.cycle = fair_cycle(labelled);
  if (endless.cycle.empty()) return std::nullopt;
  endless.child = children_[endless.cycle.front().from % count];
  for (CycleStep& step : endless.cycle) step = following.step(labelled, step);
  return endless;
}

}  // namespace lockstep::host
