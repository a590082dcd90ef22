#include "verify/fair_cycle.h"

#include <algorithm>
#include <numeric>

#include "verify/components.h"
#include "verify/shortest_path.h"
#include "verify/union_find.h"

namespace lockstep::host {
namespace {

constexpr std::uint32_t kNoSet = 0xffffffff;

// Finds a fair cycle in a component, by leaving out edges on which a leaf works that never ends in
// it. A leaf that may move is, in each state, the leaf at a place: in a component, the places that
// the edges lead it through are one set, from each of which it comes to each other one. So are the
// places of leaves in equal states.
class FairCycle {
 public:
  enum class Fairness : bool { Needed, Ignored };
  FairCycle(const Graph& graph, const EdgeFilter& filter, Fairness fairness)
      : graph_(graph),
        filter_(filter),
        fairness_(fairness),
        moving_(graph.shape.moving_leaves),
        components_(graph),
        set_(graph.states(), kNoSet),
        only_works_(graph.states() * moving_.size()),
        number_(moving_.empty() ? 0 : graph.states()) {
    std::vector<bool> moves(graph.shape.leaves);
    for (const std::uint32_t leaf : moving_) moves[leaf] = true;
    for (std::size_t leaf = 0; leaf < moves.size(); ++leaf) {
      if (!moves[leaf]) staying_.push_back(leaf);
    }
  }

  std::vector<CycleStep> find() {
    std::vector<StateId> states(graph_.expanded());
    std::iota(states.begin(), states.end(), StateId{0});
    return find(states, {});
  }

 private:
  using Leaves = std::vector<std::size_t>;
  using Component = std::vector<StateId>;

  bool works(const Edge& edge, std::size_t leaf) const {
    return graph_.has(edge, graph_.shape.worked_bit(leaf));
  }
  bool ends(const Edge& edge, std::size_t leaf) const {
    return graph_.has(edge, graph_.shape.ended_bit(leaf));
  }

  std::size_t leaf_after(const Edge& edge, std::size_t moving) const {
    Label label;
    graph_.read(edge, label);
    return label.after[moving];
  }

  bool uses(StateId from, const Edge& edge, const Leaves& without) const {
    if (filter_ && !filter_(edge)) return false;
    if (std::ranges::any_of(without, [&](std::size_t leaf) { return works(edge, leaf); })) {
      return false;
    }
    for (std::size_t i = 0; some_only_work_ && i < moving_.size(); ++i) {
      if (only_works_[from * moving_.size() + i] && works(edge, moving_[i])) return false;
    }
    return true;
  }

  std::vector<CycleStep> find(const Component& states, const Leaves& without) {
    const std::uint32_t set = sets_++;
    for (const StateId state : states) set_[state] = set;
    const auto inside = [&](StateId from, const Edge& edge) {
      return set_[edge.to] == set && uses(from, edge, without);
    };
    components_.find(states, inside);
    auto found = components_.with_cycles(states, inside);
    // The ones that a search finds first, first.
    std::ranges::sort(found, {}, [](const auto& it) { return std::ranges::min(it); });
    for (const Component& component : found) {
      const std::uint32_t number = components_.of(component.front());
      const auto within = [&](StateId from, const Edge& edge) {
        return components_.of(from) == number && components_.of(edge.to) == number &&
               uses(from, edge, without);
      };
      Leaves more = without;
      if (!leaves_out_more(component, within, more)) return walk(component, within);
      if (auto cycle = find(component, more); !cycle.empty()) return cycle;
    }
    return {};
  }

  template <class Within>
  bool leaves_out_more(const Component& component, const Within& within, Leaves& without) {
    if (fairness_ == Fairness::Ignored) return false;
    const bool some_stay = leave_out_staying(component, within, without);
    const bool some_move = !moving_.empty() && leave_out_moving(component, within);
    return some_stay || some_move;
  }

  template <class Within, class Look>
  void for_each_edge(const Component& component, const Within& within, const Look& look) const {
    for (const StateId state : component) {
      for (const Edge& edge : graph_.edges_of(state)) {
        if (within(state, edge)) look(state, edge);
      }
    }
  }

  template <class Within>
  bool leave_out_staying(const Component& component, const Within& within, Leaves& without) const {
    Label all;
    graph_.shape.clear(all);
    for_each_edge(component, within,
                  [&](StateId, const Edge& edge) { graph_.labels.read(edge.label, all); });
    const std::size_t before = without.size();
    for (const std::size_t leaf : staying_) {
      const bool only_works =
          all.has(graph_.shape.worked_bit(leaf)) && !all.has(graph_.shape.ended_bit(leaf));
      if (only_works) without.push_back(leaf);
    }
    return without.size() != before;
  }

  template <class Within>
  bool leave_out_moving(const Component& component, const Within& within) {
    const std::size_t count = moving_.size();
    for (StateId i = 0; i < component.size(); ++i) number_[component[i]] = i;
    const auto place = [&](StateId state, std::size_t i) { return number_[state] * count + i; };
    UnionFind leaves(component.size() * count);
    Label label;
    for (const StateId state : component) {
      graph_.read_equals(state, label);
      for (std::size_t i = 0; i < count; ++i)
        leaves.unite(place(state, i), place(state, label.after[i]));
    }
    for_each_edge(component, within, [&](StateId from, const Edge& edge) {
      graph_.read(edge, label);
      for (std::size_t i = 0; i < count; ++i)
        leaves.unite(place(from, i), place(edge.to, label.after[i]));
    });
    std::vector<bool> work(component.size() * count), end(component.size() * count);
    for_each_edge(component, within, [&](StateId from, const Edge& edge) {
      graph_.read(edge, label);
      for (std::size_t i = 0; i < count; ++i) {
        if (label.has(graph_.shape.worked_bit(moving_[i])))
          work[leaves.find(place(from, i))] = true;
        if (label.has(graph_.shape.ended_bit(moving_[i]))) end[leaves.find(place(from, i))] = true;
      }
    });
    bool is_more = false;
    for (const StateId state : component) {
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t leaf = leaves.find(place(state, i));
        if (!work[leaf] || end[leaf]) continue;
        only_works_[state * count + i] = is_more = true;
      }
    }
    some_only_work_ |= is_more;
    return is_more;
  }

  // All of the component is fair. A short cycle: from its first state back to it, through an end
  // of each leaf that works on that path.
  std::vector<CycleStep> walk(const Component& component, const ShortestPath::Uses& within) const {
    const StateId start = std::ranges::min(component);
    const ShortestPath path(graph_, within);
    const ShortestPath following(
        graph_, within,
        {.places = moving_.size(),
         .choices =
             [&](StateId from, const Edge&, std::size_t i, const FollowedLeaf::Take& take) {
               Label equals;
               graph_.read_equals(from, equals);
               for_each_equal(equals, i, take);
             },
         .next = [&](const Edge& edge, std::size_t i) { return leaf_after(edge, i); }});
    const auto is_start = [&](StateId, const Edge& edge, std::size_t) { return edge.to == start; };
    std::vector<CycleStep> cycle = path.find(start, is_start);
    const auto take = [&](const std::vector<CycleStep>& steps) {
      cycle.insert(cycle.end(), steps.begin(), steps.end());
      if (cycle.back().edge.to == start) return;
      const auto back = path.find(cycle.back().edge.to, is_start);
      cycle.insert(cycle.end(), back.begin(), back.end());
    };
    // Not fair yet: it also goes where the leaf ends, and back.
    while (fairness_ == Fairness::Needed) {
      if (const auto leaf = staying_that_only_works(cycle)) {
        take(path.find(start,
                       [&](StateId, const Edge& edge, std::size_t) { return ends(edge, *leaf); }));
      } else if (const auto place = moving_that_only_works(cycle)) {
        take(following.find(
            start, [&](StateId, const Edge& edge, std::size_t i) { return ends(edge, moving_[i]); },
            *place));
      } else {
        break;
      }
    }
    return cycle;
  }

  std::optional<std::size_t> staying_that_only_works(const std::vector<CycleStep>& cycle) const {
    for (const std::size_t leaf : staying_) {
      const bool work =
          std::ranges::any_of(cycle, [&](const CycleStep& it) { return works(it.edge, leaf); });
      const bool end =
          std::ranges::any_of(cycle, [&](const CycleStep& it) { return ends(it.edge, leaf); });
      if (work && !end) return leaf;
    }
    return std::nullopt;
  }

  // Where such a leaf is in the end.
  std::optional<std::size_t> moving_that_only_works(const std::vector<CycleStep>& cycle) const {
    for (std::size_t first = 0; first < moving_.size(); ++first) {
      std::size_t place = first;
      bool work = false, end = false;
      for (const CycleStep& it : cycle) {
        place = graph_.shape.exchanged(it.swaps[0], place);
        work |= works(it.edge, moving_[place]);
        end |= ends(it.edge, moving_[place]);
        place = leaf_after(it.edge, place);
      }
      if (work && !end) return place;
    }
    return std::nullopt;
  }

  const Graph& graph_;
  const EdgeFilter& filter_;
  const Fairness fairness_;
  const std::vector<std::uint32_t>& moving_;
  Leaves staying_;
  Components<> components_;
  std::vector<std::uint32_t> set_;  // of each state: the last set in which it was looked at
  std::uint32_t sets_ = 0;
  std::vector<bool> only_works_;  // of each state and each leaf that may move
  bool some_only_work_ = false;
  std::vector<StateId> number_;  // of each state: in the component
};

}  // namespace

std::vector<CycleStep> fair_cycle(const Graph& graph, const EdgeFilter& filter) {
  return FairCycle(graph, filter, FairCycle::Fairness::Needed).find();
}

std::vector<CycleStep> any_cycle(const Graph& graph, const EdgeFilter& filter) {
  return FairCycle(graph, filter, FairCycle::Fairness::Ignored).find();
}

}  // namespace lockstep::host
