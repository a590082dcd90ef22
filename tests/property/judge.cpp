#include "property/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <unordered_map>
#include <utility>

namespace lockstep::host::test {
namespace {

constexpr std::size_t kEnd = static_cast<std::size_t>(-1);

// Of one tick: where it leads, and which activations of leaves worked and ended in it.
struct Edge {
  std::size_t to;
  std::uint32_t worked, ended;
  bool is_cut;  // the process was cut before it
};

// Fair runs that never end, in some of the edges: in the end each is in one component, where what
// works also ends. Components by the sets of states that are reached: small graphs, plain code.
class FairRuns {
 public:
  using Uses = std::function<bool(std::size_t from, const Edge& edge)>;
  explicit FairRuns(const std::vector<std::vector<Edge>>& edges) : edges_(edges) {}

  // A state of one of them.
  std::optional<std::size_t> find(const Uses& uses) {
    for (const auto& component : components(uses)) {
      std::vector<bool> is_in(edges_.size());
      for (const std::size_t state : component) is_in[state] = true;
      const Uses inside = [&](std::size_t from, const Edge& edge) {
        return edge.to != kEnd && is_in[from] && is_in[edge.to] && uses(from, edge);
      };
      std::uint32_t worked = 0, ended = 0;
      bool has_edges = false;
      for (const std::size_t state : component) {
        for (const Edge& edge : edges_[state]) {
          if (!inside(state, edge)) continue;
          has_edges = true;
          worked |= edge.worked;
          ended |= edge.ended;
        }
      }
      if (!has_edges) continue;
      const std::uint32_t unfair = worked & ~ended;
      if (unfair == 0) return component.front();
      const auto found = find([&](std::size_t from, const Edge& edge) {
        return (edge.worked & unfair) == 0 && inside(from, edge);
      });
      if (found) return found;
    }
    return std::nullopt;
  }

 private:
  // Kosaraju: the order in which a search leaves states, then the reversed graph.
  std::vector<std::vector<std::size_t>> components(const Uses& uses) const {
    const std::size_t count = edges_.size();
    std::vector<std::vector<std::size_t>> next(count), before(count);
    for (std::size_t from = 0; from < count; ++from) {
      for (const Edge& edge : edges_[from]) {
        if (edge.to == kEnd || !uses(from, edge)) continue;
        next[from].push_back(edge.to);
        before[edge.to].push_back(from);
      }
    }
    std::vector<bool> was_seen(count);
    std::vector<std::size_t> left;
    for (std::size_t state = 0; state < count; ++state) visit(state, next, was_seen, left);
    was_seen.assign(count, false);
    std::vector<std::vector<std::size_t>> found;
    for (auto it = left.rbegin(); it != left.rend(); ++it) {
      std::vector<std::size_t> component;
      visit(*it, before, was_seen, component);
      if (!component.empty()) found.push_back(std::move(component));
    }
    return found;
  }

  static void visit(std::size_t start, const std::vector<std::vector<std::size_t>>& next,
                    std::vector<bool>& was_seen, std::vector<std::size_t>& left) {
    if (was_seen[start]) return;
    was_seen[start] = true;
    std::vector<std::pair<std::size_t, std::size_t>> stack{{start, 0}};
    while (!stack.empty()) {
      auto& [state, at] = stack.back();
      if (at == next[state].size()) {
        left.push_back(state);
        stack.pop_back();
        continue;
      }
      const std::size_t to = next[state][at++];
      if (was_seen[to]) continue;
      was_seen[to] = true;
      stack.emplace_back(to, 0);
    }
  }

  const std::vector<std::vector<Edge>>& edges_;
};

class Judge {
 public:
  Judge(JudgedTree& tree, JudgedLeaves& leaves, const std::vector<JudgedProperty>& properties,
        const JudgeLimits& limits)
      : tree_(tree), leaves_(leaves), properties_(properties), limits_(limits) {
    const std::size_t nodes = tree.nodes();
    said_.ticked.resize(nodes);
    said_.succeeded.resize(nodes);
    said_.failed.resize(nodes);
    said_.runs_to_ticked.resize(nodes);
    said_.violated.resize(properties.size());
    said_.runs_to_violated.resize(properties.size());
  }

  Judgment make() {
    add({tree_.save(), 0, "", 0, 0, std::string(properties_.size(), '-')});
    for (std::size_t state = 0; state < states_.size() && said_.is_conclusive(); ++state) {
      edges_.emplace_back();
      look_at(state, false);
      if (states_[state].cuts < limits_.cuts) look_at(state, true);
      said_.is_too_large |= states_.size() > limits_.states || ticks_ > limits_.ticks;
    }
    said_.states = states_.size();
    if (said_.is_conclusive()) look_at_ends();
    return std::move(said_);
  }

 private:
  struct State {
    std::string bytes;
    std::size_t from;
    std::string said;  // in the tick from there
    std::uint32_t ticks;
    int cuts;
    std::string came;  // of each property that waits for something: '+' if it has come
  };

  std::size_t add(State state) {
    const auto [it, is_new] =
        numbers_.try_emplace(std::to_string(state.cuts) + state.came + state.bytes, states_.size());
    if (is_new) states_.push_back(std::move(state));
    return it->second;
  }

  void look_at(std::size_t state, bool is_cut) {
    leaves_.first_answers();
    do {
      const std::string bytes = states_[state].bytes;
      tree_.restore(bytes);
      leaves_.begin_tick();
      if (is_cut && !tree_.cut()) return;
      leaves_.drift();
      is_cut_ = is_cut;
      came_ = states_[state].came;
      ++ticks_;
      const std::optional<Status> status = tree_.tick();
      if (!leaves_.broken().empty()) said_.broken = leaves_.broken();
      if (!status) return void(said_.has_fault = true);
      look_at_tick(state);
      std::size_t to = kEnd;
      if (*status == Status::Running) {
        to = add({tree_.save(), state, said(), states_[state].ticks + 1,
                  states_[state].cuts + (is_cut ? 1 : 0), came_});
      } else if (auto& first = said_.results[index_of(*status)]; !first) {
        first = states_[state].ticks + 1;
        said_.runs_to_results[index_of(*status)] = run_to(state, true);
      }
      edges_.back().push_back({to, leaves_.worked(), leaves_.ended(), is_cut});
    } while (ticks_ <= limits_.ticks && leaves_.next_answers());
  }

  std::string said() const { return (is_cut_ ? "cut: " : "") + leaves_.said(); }

  void look_at_tick(std::size_t state) {
    ReferenceMoment after;
    for (std::size_t node = 0; node < said_.ticked.size(); ++node) {
      after.push_back({tree_.status(node), tree_.ticked(node)});
    }
    for (const ReferenceMoment& moment : tree_.moments()) look_at_moment(state, moment);
    look_at_moment(state, after);
  }

  void look_at_moment(std::size_t state, const ReferenceMoment& moment) {
    for (std::size_t node = 0; node < said_.ticked.size(); ++node) {
      if (!moment[node].ticked) continue;
      if (!said_.ticked[node]) said_.runs_to_ticked[node] = run_to(state, true);
      said_.ticked[node] = true;
      if (moment[node].status == Status::Success) said_.succeeded[node] = true;
      if (moment[node].status == Status::Failure) said_.failed[node] = true;
    }
    for (std::size_t i = 0; i < properties_.size(); ++i) {
      const JudgedProperty& it = properties_[i];
      const bool one = holds(it.one, moment), has_come = it.is_after ? came_[i] == '+' : one;
      if (it.is_after && one) came_[i] = '+';
      if (said_.violated[i] || !has_come || !holds(it.other, moment)) continue;
      said_.violated[i] = states_[state].ticks + 1;
      said_.runs_to_violated[i] = run_to(state, true);
    }
  }

  static bool holds(const JudgedProperty::Fact& fact, const ReferenceMoment& moment) {
    const Status status = moment[fact.node].status;
    switch (fact.what) {
      case JudgedProperty::What::Running:
        return status == Status::Running;
      case JudgedProperty::What::Success:
        return status == Status::Success;
      case JudgedProperty::What::Failure:
        return status == Status::Failure;
      case JudgedProperty::What::Ticked:
        break;
    }
    return moment[fact.node].ticked;
  }

  void look_at_ends() {
    std::vector<bool> can_end(edges_.size());
    for (bool is_more = true; is_more;) {
      is_more = false;
      for (std::size_t state = edges_.size(); state-- > 0;) {
        if (can_end[state]) continue;
        can_end[state] = std::ranges::any_of(edges_[state], [&](const Edge& it) {
          return !it.is_cut && (it.to == kEnd || can_end[it.to]);
        });
        is_more |= can_end[state];
      }
    }
    for (std::size_t state = 0; state < can_end.size(); ++state) {
      auto& lost = states_[state].cuts == 0 ? said_.lost : said_.lost_by_cuts;
      if (can_end[state] || lost) continue;
      lost = states_[state].ticks;
      if (said_.run_to_lost.empty()) said_.run_to_lost = run_to(state, false);
    }
    const auto cycle = FairRuns(edges_).find([&](std::size_t from, const Edge& edge) {
      return can_end[from] && edge.to != kEnd && can_end[edge.to];
    });
    said_.is_endless = cycle.has_value();
    if (cycle) said_.run_to_cycle = run_to(*cycle, false);
  }

  // A line for each tick to a state, and if wanted for the last one, too.
  std::string run_to(std::size_t state, bool with_last) const {
    std::vector<std::string> lines;
    if (with_last) lines.push_back(said());
    for (; state != 0; state = states_[state].from) lines.push_back(states_[state].said);
    std::string run;
    for (auto it = lines.rbegin(); it != lines.rend(); ++it) run += "    " + *it + '\n';
    return run;
  }

  JudgedTree& tree_;
  JudgedLeaves& leaves_;
  const std::vector<JudgedProperty>& properties_;
  const JudgeLimits limits_;
  std::unordered_map<std::string, std::size_t> numbers_;
  std::vector<State> states_;
  std::vector<std::vector<Edge>> edges_;
  std::size_t ticks_ = 0;
  bool is_cut_ = false;  // before the last tick
  std::string came_;     // as in State, in the last tick
  Judgment said_;
};

}  // namespace

Judgment judge(JudgedTree& tree, JudgedLeaves& leaves,
               const std::vector<JudgedProperty>& properties, const JudgeLimits& limits) {
  return Judge(tree, leaves, properties, limits).make();
}

}  // namespace lockstep::host::test
