#include "verify/probability.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "verify/components.h"

namespace lockstep::host {
namespace {

using Target = DecisionProcess::Target;

constexpr double kEnough = 1e-10;  // the width of bounds at which a component is done

std::vector<Vertex> those(const std::vector<bool>& may) {
  std::vector<Vertex> vertices;
  for (Vertex it = 0; it < may.size(); ++it) {
    if (may[it]) vertices.push_back(it);
  }
  return vertices;
}

std::vector<Vertex> all_of(const DecisionProcess& process) {
  std::vector<Vertex> vertices(process.states());
  std::iota(vertices.begin(), vertices.end(), Vertex{0});
  return vertices;
}

// Thrown where the time is over before a question has an answer that is more than nothing.
struct TimeIsOver {};
void look_at_time(const std::function<bool()>& is_over) {
  if (is_over()) throw TimeIsOver();
}

// Of each vertex, those that lead to it.
class Predecessors {
 public:
  explicit Predecessors(const DecisionProcess& process) : first_(process.states() + 1) {
    const auto count = static_cast<Vertex>(process.states());
    for (Vertex it = 0; it < count; ++it) {
      for (const Target& target : process.edges_of(it)) ++first_[target.to + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    all_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (Vertex it = 0; it < count; ++it) {
      for (const Target& target : process.edges_of(it)) all_[next[target.to]++] = it;
    }
  }
  std::span<const Vertex> of(Vertex vertex) const {
    return std::span(all_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<Vertex> all_;
};

// The largest sets of these vertices in which a run can stay for ever, whatever chance does: the
// number of each vertex's, or kNoState. Others are taken out of `may`.
std::vector<std::uint32_t> end_components(const DecisionProcess& process, std::vector<bool>& may,
                                          const std::function<bool()>& is_over) {
  Components components(process);
  const Predecessors predecessors(process);
  const auto uses = [&](Vertex, const Target& it) { return bool(may[it.to]); };
  const auto can_stay = [&](Vertex vertex) {
    const auto stays = [&](const Target& it) {
      return may[it.to] && components.of(it.to) == components.of(vertex);
    };
    const auto targets = process.edges_of(vertex);
    return process.is_by_chance(vertex) ? std::ranges::all_of(targets, stays)
                                        : std::ranges::any_of(targets, stays);
  };
  std::vector<Vertex> vertices, leaving;
  for (bool is_done = false; !is_done;) {
    look_at_time(is_over);
    vertices = those(may);
    components.find(vertices, uses);
    for (const Vertex it : vertices) {
      if (!can_stay(it)) leaving.push_back(it);
    }
    is_done = leaving.empty();
    for (const Vertex it : leaving) may[it] = false;
    while (!leaving.empty()) {  // and who has to go with it
      const Vertex gone = leaving.back();
      leaving.pop_back();
      for (const Vertex it : predecessors.of(gone)) {
        if (!may[it] || components.of(it) != components.of(gone) || can_stay(it)) continue;
        may[it] = false;
        leaving.push_back(it);
      }
    }
  }
  std::vector<std::uint32_t> numbers(process.states(), kNoState);
  for (const Vertex it : vertices) numbers[it] = components.of(it);
  return numbers;
}

// The process in which each set of vertices where a run can stay for ever is one vertex, which
// chooses a way out. Only then the bounds from above come down.
class Collapsed {
 public:
  Collapsed(const DecisionProcess& process, const std::vector<Worth>& worth,
            const std::function<bool()>& is_over)
      : number_(process.states(), kNoState) {
    std::vector<bool> may(process.states());
    for (Vertex it = 0; it < may.size(); ++it)
      may[it] = worth[it] == Worth::GoesOn && !process.edges_of(it).empty();
    const std::vector<std::uint32_t> sets = end_components(process, may, is_over);
    std::map<std::uint32_t, Vertex> of_set;
    std::vector<std::vector<Vertex>> members;
    for (Vertex it = 0; it < number_.size(); ++it) {
      const auto next = static_cast<Vertex>(members.size());
      number_[it] = sets[it] == kNoState ? next : of_set.try_emplace(sets[it], next).first->second;
      if (number_[it] == next) members.emplace_back();
      members[number_[it]].push_back(it);
    }
    for (const std::vector<Vertex>& it : members) add(process, worth, it);
    find_hopeless();
  }

  Bounds solve(Vertex first, const std::function<bool()>& is_over) {
    Components components(process_);
    const std::vector<Vertex> all = all_of(process_);
    components.find(all, [](Vertex, const Target&) { return true; });
    const std::vector<Vertex> order = components.in_order(all);
    for (auto begin = order.begin(); begin != order.end();) {
      const auto end = std::find_if(begin, order.end(), [&](Vertex it) {
        return components.of(it) != components.of(*begin);
      });
      solve({begin, end}, is_over);
      begin = end;
    }
    return bounds_[number_[first]];
  }

 private:
  // Those that come to nothing of worth are worth nothing at once, however long a run stays there.
  void find_hopeless() {
    const Predecessors predecessors(process_);
    std::vector<bool> has_hope(process_.states());
    std::vector<Vertex> next;
    for (Vertex it = 0; it < has_hope.size(); ++it) {
      if (!process_.edges_of(it).empty() || bounds_[it].high <= 0) continue;
      has_hope[it] = true;
      next.push_back(it);
    }
    while (!next.empty()) {
      const Vertex from = next.back();
      next.pop_back();
      for (const Vertex it : predecessors.of(from)) {
        if (has_hope[it]) continue;
        has_hope[it] = true;
        next.push_back(it);
      }
    }
    for (Vertex it = 0; it < has_hope.size(); ++it) {
      if (!has_hope[it]) bounds_[it].high = 0;
    }
  }

  // One vertex, or those of a set.
  void add(const DecisionProcess& process, const std::vector<Worth>& worth,
           const std::vector<Vertex>& members) {
    std::vector<Target> targets;
    Bounds bounds{0, 1};
    const Vertex first = members.front();
    const bool is_by_chance = members.size() == 1 && process.is_by_chance(first);
    if (worth[first] == Worth::GoesOn) {
      for (const Vertex it : members) {
        for (const Target& target : process.edges_of(it)) {
          const Vertex to = number_[target.to];
          if (is_by_chance || to != number_[first])
            targets.push_back({to, is_by_chance ? target.chance : 0});
        }
      }
      if (targets.empty()) bounds.high = 0;  // it stays for ever
    }
    if (worth[first] == Worth::One) bounds.low = 1;
    if (worth[first] == Worth::Nothing) bounds.high = 0;
    bounds_.push_back(bounds);
    process_.add(targets, is_by_chance);
  }

  // A component of which all is known that it leads to.
  void solve(std::span<const Vertex> vertices, const std::function<bool()>& is_over) {
    constexpr std::uint32_t kBetweenLooks = 4096;
    const bool is_alone =
        vertices.size() == 1 &&
        std::ranges::none_of(process_.edges_of(vertices.front()),
                             [&](const Target& it) { return it.to == vertices.front(); });
    double width = 1;
    bool has_changed = true;
    for (bool is_done = false; !is_done; is_done = is_alone || !has_changed || width <= kEnough) {
      width = 0;
      has_changed = false;
      for (const Vertex it : vertices) {
        if (process_.edges_of(it).empty()) continue;
        const Bounds before = bounds_[it], next = look(it);
        bounds_[it] = {std::max(before.low, next.low), std::min(before.high, next.high)};
        width = std::max(width, bounds_[it].width());
        has_changed |= bounds_[it].low != before.low || bounds_[it].high != before.high;
        if (++looks_ % kBetweenLooks == 0 && is_over()) return;
      }
    }
  }

  // Rounded so that the number stays in them, also if each chance is off by its rounding.
  Bounds look(Vertex vertex) const {
    const auto targets = process_.edges_of(vertex);
    Bounds sum{0, 0};
    if (!process_.is_by_chance(vertex)) {
      for (const Target& it : targets) {
        sum.low = std::max(sum.low, bounds_[it.to].low);
        sum.high = std::max(sum.high, bounds_[it.to].high);
      }
      return sum;
    }
    for (const Target& it : targets) {
      sum.low += it.chance * bounds_[it.to].low;
      sum.high += it.chance * bounds_[it.to].high;
    }
    const double rounding =
        static_cast<double>(targets.size() + 8) * std::numeric_limits<double>::epsilon();
    return {sum.low * (1 - rounding), std::min(1.0, sum.high * (1 + rounding))};
  }

  std::vector<Vertex> number_;  // of each vertex: in `process_`
  DecisionProcess process_;
  std::vector<Bounds> bounds_;
  std::uint32_t looks_ = 0;
};

class ChanceQuestions {
 public:
  ChanceQuestions(const ChanceGraph& graph, const std::function<bool()>& is_stopped,
                  std::optional<Nanoseconds> until)
      : graph_(graph),
        process_(graph.process),
        until_(until),
        is_over_(
            [is_stopped, until] { return is_stopped() || (until && monotonic_now() > *until); }),
        unfair_(graph.process.states()) {
    std::vector<bool> may(process_.states(), true);
    may[graph_.unknown] = false;
    for (const TickEnd& it : graph_.ends) may[it.vertex] = it.to != kNoState;
    const auto any = [](const TickEnd&) { return true; };
    try {
      find_unfair(fair(may, any));
      endless_ = fair(may, any);
    } catch (const TimeIsOver&) {
      endless_.clear();
    }
  }

  Probabilities answer() {
    Probabilities all;
    std::array<bool, kStatuses.size()> has{};
    bool has_fault = false;
    for (const TickEnd& it : graph_.ends) {
      if (it.result) has[index_of(*it.result)] = true;
      has_fault |= it.has_fault();
    }
    if (graph_.end != SearchEnd::Complete)
      has[index_of(Status::Success)] = has[index_of(Status::Failure)] = true;
    const auto ends = std::ranges::count(has, true) + (has_fault ? 1 : 0) + 1;
    bounds_left_ = 2 * (static_cast<std::size_t>(ends) + graph_.shape.properties);
    for (std::size_t i = 0; i < has.size(); ++i) {
      if (!has[i]) continue;
      all.results[i] =
          ending([&](const TickEnd& it) { return it.result && index_of(*it.result) == i; });
    }
    if (has_fault) all.fault = ending([](const TickEnd& it) { return it.has_fault(); });
    all.ends = ending([](const TickEnd&) { return true; });
    for (std::uint32_t i = 0; i < graph_.shape.properties; ++i)
      all.properties.push_back(holding(i));
    all.is_cut = is_cut_ || is_over_();
    return all;
  }

 private:
  using TickEnd = ChanceGraph::TickEnd;

  std::vector<Worth> unknown_worth() const {
    std::vector<Worth> worth(process_.states(), Worth::GoesOn);
    worth[graph_.unknown] = Worth::Unknown;
    return worth;
  }
  Bounds largest(const std::vector<Worth>& worth) {
    try {
      Collapsed collapsed(process_, worth, is_over_);
      const Nanoseconds now = monotonic_now();
      std::optional<Nanoseconds> share;
      if (until_) share = now + (*until_ - now) / static_cast<std::int64_t>(bounds_left_);
      bounds_left_ = std::max<std::size_t>(bounds_left_, 2) - 1;
      return collapsed.solve(graph_.first, [&] {
        const bool is_over = is_over_() || (share && monotonic_now() > *share);
        is_cut_ |= is_over;
        return is_over;
      });
    } catch (const TimeIsOver&) {
      return {};
    }
  }
  // The most is no less than the least, whichever of them is known better.
  static Probability between(Bounds least, Bounds most) {
    return {{least.low, std::min(least.high, most.high)},
            {std::max(least.low, most.low), most.high}};
  }
  static Bounds rest(const Bounds& it) { return {1 - it.high, 1 - it.low}; }

  // That the run ends in this way.
  template <class IsWanted>
  Probability ending(const IsWanted& is_wanted) {
    if (endless_.empty()) return {};  // it is not known yet
    std::vector<Worth> this_way = unknown_worth(), otherwise = this_way;
    for (const TickEnd& it : graph_.ends) {
      if (it.to != kNoState) continue;
      const bool wanted = is_wanted(it);
      this_way[it.vertex] = wanted ? Worth::One : Worth::Nothing;
      otherwise[it.vertex] = wanted ? Worth::Nothing : Worth::One;
    }
    for (const Vertex it : those(endless_)) otherwise[it] = Worth::One;
    return between(rest(largest(otherwise)), largest(this_way));
  }

  // That the property holds. One that waits for something for ever is violated.
  Probability holding(std::uint32_t property) try {
    look_at_time(is_over_);
    std::vector<Worth> holds = unknown_worth(), violated = holds;
    std::vector<bool> open(process_.states(), true);
    open[graph_.unknown] = false;
    std::vector<bool> waits = open;
    const std::size_t owed = graph_.shape.owed_bit(property);
    for (const TickEnd& it : graph_.ends) {
      const bool is_violated = std::ranges::binary_search(it.violated, property);
      if (is_violated || it.to == kNoState) {
        holds[it.vertex] = is_violated ? Worth::Nothing : Worth::One;
        violated[it.vertex] = is_violated ? Worth::One : Worth::Nothing;
        open[it.vertex] = waits[it.vertex] = false;
      } else if (!graph_.labels.has(it.label, owed)) {
        waits[it.vertex] = false;
      }
    }
    const std::vector<bool> waiting = fair(waits, [](const TickEnd&) { return true; });
    for (const Vertex it : those(waiting)) violated[it] = Worth::One;
    const std::vector<bool> going =
        fair(open, [&](const TickEnd& it) { return !graph_.labels.has(it.label, owed); });
    for (const Vertex it : those(going)) holds[it] = Worth::One;
    return between(rest(largest(violated)), largest(holds));
  } catch (const TimeIsOver&) {
    return {};
  }

  // From where no run ends or goes on as fairness has it: some leaf gets ticks and cannot end.
  void find_unfair(const std::vector<bool>& stays) {
    const std::vector<Vertex> all = all_of(process_);
    Components components(process_);
    components.find(all, [](Vertex, const Target&) { return true; });
    std::vector<bool> is_fair(components.count());
    for (const Vertex it : components.in_order(all)) {
      const auto targets = process_.edges_of(it);
      const auto leads_out = [&](const Target& to) { return is_fair[components.of(to.to)]; };
      if (targets.empty() || stays[it] || std::ranges::any_of(targets, leads_out))
        is_fair[components.of(it)] = true;
    }
    for (const Vertex it : all) unfair_[it] = !is_fair[components.of(it)];
  }

  // The vertices among these in which a run can stay for ever, so that each leaf that works again
  // and again also ends, and some of these ticks come again and again.
  template <class IsWanted>
  std::vector<bool> fair(std::vector<bool> may, const IsWanted& is_wanted) const {
    const std::size_t leaves = graph_.shape.leaves;
    struct Seen {
      std::vector<bool> works, ends;
      bool is_wanted = false;
    };
    const auto has = [&](const TickEnd& it, std::size_t bit) {
      return graph_.labels.has(it.label, bit);
    };
    for (bool is_done = false; !is_done;) {
      is_done = true;
      const std::vector<std::uint32_t> sets = end_components(process_, may, is_over_);
      std::map<std::uint32_t, Seen> seen;
      const auto for_each_end = [&](const auto& call) {
        for (const TickEnd& it : graph_.ends) {
          if (it.to != kNoState && sets[it.vertex] != kNoState) call(it, seen[sets[it.vertex]]);
        }
      };
      for_each_end([&](const TickEnd& it, Seen& of) {
        of.works.resize(leaves);
        of.ends.resize(leaves);
        for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
          if (has(it, graph_.shape.worked_bit(leaf))) of.works[leaf] = true;
          if (has(it, graph_.shape.ended_bit(leaf))) of.ends[leaf] = true;
        }
        of.is_wanted |= is_wanted(it);
      });
      for_each_end([&](const TickEnd& it, const Seen& of) {
        bool is_left_out = !of.is_wanted;
        for (std::size_t leaf = 0; leaf < leaves && !is_left_out; ++leaf) {
          is_left_out = of.works[leaf] && !of.ends[leaf] &&
                        has(it, graph_.shape.worked_bit(leaf)) && !unfair_[it.vertex];
        }
        if (!is_left_out) return;
        may[it.vertex] = false;
        is_done = false;
      });
    }
    return may;
  }

  const ChanceGraph& graph_;
  const DecisionProcess& process_;
  const std::optional<Nanoseconds> until_;
  const std::function<bool()> is_over_;
  std::vector<bool> unfair_, endless_;
  std::size_t bounds_left_ = 1;  // to compute, each with the same share of the time
  bool is_cut_ = false;
};

}  // namespace

Bounds largest_chance(const DecisionProcess& process, Vertex first, const std::vector<Worth>& worth,
                      const std::function<bool()>& is_over) {
  return Collapsed(process, worth, is_over).solve(first, is_over);
}

Probabilities probabilities(const ChanceGraph& graph, const std::function<bool()>& is_over,
                            std::optional<Nanoseconds> until) {
  return ChanceQuestions(graph, is_over, until).answer();
}

}  // namespace lockstep::host
