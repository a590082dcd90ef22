#include "verify/search.h"

#include <algorithm>
#include <set>

#include "engine/blackboard.h"

namespace lockstep::host {
namespace {

class Searcher {
 public:
  Searcher(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
           Nanoseconds period, const SearchLimits& limits)
      : tree_(tree),
        limits_(limits),
        stepper_(tree, models, properties, period),
        labeller_(tree, models, properties.size()),
        properties_(properties.size()),
        result_(tree) {
    result_.graph.leaves = tree.leaves.size();
    result_.graph.held = labeller_.held().size();
    result_.graph.properties = properties_;
    for (std::uint32_t slot = 0; slot < models.entries.size(); ++slot) {
      if (models.entries[slot]) values_.emplace_back(slot, std::set<std::string>());
    }
  }

  SearchResult search() {
    add(stepper_.first_state(), {});
    result_.depths.push_back(0);
    for (StateId state = 0; state < result_.store.size(); ++state) {
      if (state == next_depth_) {
        next_depth_ = static_cast<StateId>(result_.store.size());
        if (state != 0) result_.depths.push_back(state);
      }
      if (is_over(state) || !expand(state)) break;
    }
    result_.took = monotonic_now() - began_;
    return std::move(result_);
  }

 private:
  std::uint32_t depth() const { return static_cast<std::uint32_t>(result_.depths.size()) - 1; }

  bool is_over(StateId state) {
    const auto stop = [&](SearchEnd end) {
      result_.end = end;
      return true;
    };
    if (!result_.note.empty()) return stop(SearchEnd::Values);
    if (result_.store.size() > limits_.states) return stop(SearchEnd::States);
    if (limits_.depth && depth() >= *limits_.depth) return stop(SearchEnd::Depth);
    if (result_.transitions < next_look_) return false;
    next_look_ = result_.transitions + 1000;
    if (limits_.stop_signal && (result_.signal = limits_.stop_signal()) != 0) {
      return stop(SearchEnd::Signal);
    }
    const Nanoseconds now = monotonic_now();
    if (limits_.time && now - began_ > *limits_.time) return stop(SearchEnd::Time);
    const std::size_t memory = result_.memory();
    if (memory > limits_.memory) return stop(SearchEnd::Memory);
    if (limits_.tell && now - told_ > std::chrono::milliseconds(100)) {
      told_ = now;
      limits_.tell({result_.store.size(), result_.store.size() - state, result_.transitions,
                    depth(), memory});
    }
    return false;
  }

  StateId add(const StateBytes& bytes, Step step) {
    const auto [id, is_new] = result_.store.add(bytes);
    if (is_new) {
      result_.before.push_back(step);
      result_.graph.ends.push_back(false);
    }
    return id;
  }

  // False: a limit was reached before all of its answers were tried.
  bool expand(StateId state) {
    const auto from = result_.store[state];
    loaded_.assign(from.begin(), from.end());
    stepper_.load(loaded_, state == 0);
    edges_.clear();
    Step step{state, 0};
    do {
      take(step, stepper_.tick());
      ++step.combination;
      if (result_.transitions >= next_look_ && is_over(state)) return false;
    } while (stepper_.next());
    std::ranges::sort(edges_);
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    Graph& graph = result_.graph;
    graph.edges.insert(graph.edges.end(), edges_.begin(), edges_.end());
    graph.begins.push_back(graph.edges.size());
    return true;
  }

  void take(const Step& step, Status status) {
    ++result_.transitions;
    Ticker& ticker = stepper_.ticker();
    const Occurrence here{step, depth() + 1};
    result_.coverage.after_tick(ticker);
    for (const std::size_t it : stepper_.violated()) result_.violated.try_emplace(it, here);
    if (!stepper_.leaves().broken().empty() && !result_.broken) {
      result_.broken.emplace(stepper_.leaves().broken(), here);
    }
    if (const Fault* fault = ticker.fault()) {
      result_.faults.try_emplace(fault->node, fault->message, here);
      result_.graph.ends[step.from] = true;
      return;
    }
    if (status != Status::Running) {
      auto& first = result_.results[index_of(status)];
      if (!first) first = here;
      result_.graph.ends[step.from] = true;
      return;
    }
    count_values(ticker);
    const std::uint32_t label = result_.graph.labels.add(labeller_.of(stepper_));
    edges_.push_back({add(stepper_.fold(), step), label});
  }

  // An entry with more and more values has no end of states.
  void count_values(const Ticker& ticker) {
    for (auto& [slot, known] : values_) {
      const Value& value = ticker.blackboard().entries[slot].value;
      if (std::holds_alternative<NoValue>(value) || known.size() > limits_.values) continue;
      known.insert(to_text(value));
      if (known.size() > limits_.values) result_.note = tree_.slots[slot].name;
    }
  }

  const Tree& tree_;
  const SearchLimits& limits_;
  Stepper stepper_;
  Labeller labeller_;
  const std::size_t properties_;
  SearchResult result_;
  StateBytes loaded_;
  std::vector<Edge> edges_;
  std::vector<std::pair<std::uint32_t, std::set<std::string>>> values_;
  StateId next_depth_ = 0;
  std::uint64_t next_look_ = 0;
  const Nanoseconds began_ = monotonic_now();
  Nanoseconds told_{0};
};

}  // namespace

std::uint32_t SearchResult::depth_of(StateId state) const {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(depths, state) - depths.begin()) - 1;
}

std::uint32_t SearchResult::complete_depth() const {
  const auto expanded = static_cast<StateId>(graph.expanded());
  if (expanded >= store.size()) return static_cast<std::uint32_t>(depths.size());
  return depth_of(expanded);
}

std::vector<Step> SearchResult::way_to(StateId state) const {
  std::vector<Step> way;
  for (; state != 0; state = before[state].from) way.push_back(before[state]);
  std::ranges::reverse(way);
  return way;
}

std::size_t SearchResult::memory() const {
  return store.memory() + before.capacity() * sizeof(Step) + graph.edges.capacity() * sizeof(Edge) +
         graph.begins.capacity() * sizeof(std::uint64_t);
}

SearchResult search(const Tree& tree, const LeafModels& models,
                    std::span<const Property> properties, Nanoseconds period,
                    const SearchLimits& limits) {
  return Searcher(tree, models, properties, period, limits).search();
}

}  // namespace lockstep::host
