#include "verify/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/core/wording.h"
#include "engine/synchronized.h"
#include "run/cut_text.h"
#include "verify/assumptions.h"
#include "verify/explanation.h"
#include "verify/fair_cycle.h"
#include "verify/fixed_conditions.h"
#include "verify/holds.h"

namespace lockstep::host {
namespace {

// The names of findings, or how they begin: "starvation/T/Parallel/Advance".
constexpr std::string_view kTrap = "trap", kTrapAfterCut = "trap-after-cut", kCycle = "cycle",
                           kStarvation = "starvation/", kNeverTicked = "never-ticked/",
                           kFault = "fault/", kOrder = "order/", kBarrierPassed = "barrier-passed/",
                           kDoneTwice = "done-twice/";

class VerdictMaker {
 public:
  VerdictMaker(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
               const SearchResult& found, const VerdictOptions& options)
      : tree_(tree),
        models_(models),
        properties_(properties),
        found_(found),
        graph_(found.graph),
        cycles_(found.graph_of_cycles()),
        options_(options),
        held_(holdable(tree)),
        tracer_(tree, models, properties, options.rate, found),
        explainer_(tree, tracer_, options.rate) {}

  Verdict make() {
    say_symmetry();
    say_results();
    look_for_traps();
    look_for_cycles();
    look_for_starvation();
    look_for_dead_nodes();
    look_at_violations();
    say_coverage();
    say_holds();
    note_cuts();
    accept();
    assume();
    return std::move(verdict_);
  }

 private:
  void say(std::string name, std::string text) {
    verdict_.facts.push_back({std::move(name), std::move(text)});
  }
  void say_good(std::string name, std::string text) {
    verdict_.facts.push_back({std::move(name), std::move(text), true});
  }
  void say_or_none(std::string name, const std::vector<std::string>& nodes) {
    say(std::move(name), nodes.empty() ? "none" : some_of(nodes, kMostNamesInLine));
  }
  std::string at(NodeIndex node) const {
    const std::string place = options_.place ? options_.place(node) : "";
    return place.empty() ? tree_.path(node) : fmt::format("{} ({})", tree_.path(node), place);
  }
  TracedRun run_to(const Occurrence& it) {
    TracedPath traced = tracer_.begin();
    tracer_.go(traced, found_.path_to(it.from));
    tracer_.go(traced, it);
    return std::move(traced.run);
  }

  // Nothing: the time is over.
  template <class Question>
  auto in_time(const Question& question) -> std::optional<decltype(question())> {
    const TimeLimit::Span span(*found_.time_limit, options_.until);
    try {
      return question();
    } catch (const OutOfTime&) {
      return std::nullopt;
    }
  }
  // A question that has a wrong answer, or may have.
  template <class Question>
  auto answer(std::string name, const Question& question) {
    auto answer = in_time(question);
    if (!answer) {
      say(std::move(name), not_known("--time"));
      verdict_.is_cut = true;
    }
    return answer;
  }
  static std::string not_known(std::string_view limit) {
    return fmt::format("not known: {} leaves nothing for it", limit);
  }

  void say_symmetry() {
    for (const EqualChildren& it : found_.symmetry.classes()) {
      const NodeIndex first = it.places.front().node;
      // One line for the classes of parallels that are alike themselves.
      if (found_.symmetry.first_like(first) != first) continue;
      std::vector<std::string> names;
      for (const auto& place : it.places) names.push_back(tree_.segment(place.node));
      say("alike",
          fmt::format("{} of {}: they may do the same, so states in which they have "
                      "changed places count once",
                      some_of(names, kMostNamesInLine), tree_.path(tree_.labels[first].parent)));
    }
  }

  // --- how a run ends ----------------------------------------------------------------------------

  void say_results() {
    std::vector<std::string> results;
    for (const Status status : {Status::Success, Status::Failure, Status::Skipped}) {
      const auto& first = found_.results[index_of(status)];
      if (first) {
        results.push_back(
            fmt::format("{} (from {})", to_string(status), counted(first->ticks, "tick")));
      }
    }
    const char* const none = !found_.is_complete()   ? "none so far"
                             : found_.faults.empty() ? "none: no behavior ends"
                                                     : "none: each end is a fault";
    say("results", results.empty() ? none : joined(results, ", "));
  }

  void look_for_traps() {
    if (!models_.tree_ends) return;
    auto can = answer("can always end", [&] { return can_end(graph_); });
    if (!can) return;
    can_end_ = *std::move(can);
    StateId trapped = 0;
    while (trapped < graph_.states() && (can_end_[trapped] || cuts_before(trapped) > 0)) ++trapped;
    if (trapped < graph_.states()) {
      Finding trap = trap_at(found_.path_to(trapped), std::string(kTrap));
      say("can always end", "NO: " + trap.message);
      verdict_.findings.push_back(std::move(trap));
    } else if (found_.is_complete()) {
      say_good("can always end", "yes");
    }
    if (models_.cuts.most > 0) look_for_traps_after_cuts();
  }

  std::uint8_t cuts_before(StateId state) const {
    return graph_.cuts.empty() ? std::uint8_t{0} : graph_.cuts[state];
  }

  void look_for_traps_after_cuts() {
    const char* const name = "can always end after a cut";
    const auto path = answer(name, [&] { return path_to_trap_after_cut(); });
    if (!path) return;
    if (!path->empty()) {
      Finding trap = trap_at(*path, std::string(kTrapAfterCut));
      say(name, "NO: " + trap.message);
      verdict_.findings.push_back(std::move(trap));
    } else if (found_.is_complete()) {
      say_good(name, verdict_.findings.empty() ? "yes" : "as without one");
    }
  }

  // To a state to which no run comes with fewer cuts, from one that could end; empty: there is
  // none.
  std::vector<StateId> path_to_trap_after_cut() const {
    for (StateId from = 0; from < graph_.expanded(); ++from) {
      if (!can_end_[from]) continue;
      for (const Edge& edge : graph_.edges_of(from)) {
        const StateId to = edge.to;
        if (can_end_[to] || cuts_before(to) == 0 || is_known_with_fewer_cuts(to)) continue;
        std::vector<StateId> path = found_.path_to(from);
        path.push_back(to);
        return path;
      }
    }
    return {};
  }

  bool is_known_with_fewer_cuts(StateId state) const {
    if (found_.store.keeps_hashes()) return !verdict_.findings.empty();
    const auto bytes = found_.store[state];
    StateBytes fewer(bytes.begin(), bytes.end());
    while (StateCode::cuts_of(fewer) > 0) {
      StateCode::set_cuts_of(fewer, static_cast<std::uint8_t>(StateCode::cuts_of(fewer) - 1));
      if (found_.store.find(fewer, hash_of(fewer)) != kNoState) return true;
    }
    return false;
  }

  // At the end of the path, which is the first state of it that cannot end.
  Finding trap_at(const std::vector<StateId>& path, std::string name) {
    Finding trap{.name = std::move(name), .message = {}};
    const StateId state = path.back();
    const std::size_t ticks = path.size() - 1;
    const std::vector<bool> reached = reachable_from(graph_, state);
    const EdgeFilter inside = [&](const Edge& edge) { return bool(reached[edge.to]); };
    const auto cycle = in_time([&] {
      auto fair = fair_cycle(cycles_, inside);
      return fair.empty() || !reached[fair.front().from] ? any_cycle(cycles_, inside) : fair;
    });
    add_lasso(path, cycle.value_or(std::vector<CycleStep>()), trap, tracer_.begin());
    trap.message = ticks == 0
                       ? "it can never end"
                       : fmt::format("after {}{} it can no longer end", counted(ticks, "tick"),
                                     cuts_before(state) > 0 ? " and a cut" : "");
    trap.more = explainer_.why_it_stands(trap);
    if (!found_.store.keeps_hashes()) {
      const auto place = [&](NodeIndex node) { return at(node); };
      for (auto& line : false_for_ever(tree_, models_, tracer_, reached, place, options_.until)) {
        trap.more.push_back(std::move(line));
      }
    }
    if (ticks == 0) {
      trap.more.push_back(
          "if it is meant to run indefinitely, declare that in the leaf model: <tree "
          "ends=\"no\"/>");
    }
    return trap;
  }

  // The ticks to a state, from it to the cycle, and two rounds of that.
  void add_lasso(StateId from, const std::vector<CycleStep>& cycle, Finding& finding) {
    add_lasso(found_.path_to(from), cycle, finding, tracer_.begin());
  }
  void add_lasso(const std::vector<StateId>& path, const std::vector<CycleStep>& cycle,
                 Finding& finding, TracedPath traced) {
    tracer_.go(traced, path);
    finding.decided = traced.run.size();
    if (!cycle.empty()) {
      tracer_.go(traced, way_to_cycle(path.back(), cycle));
      finding.repeats = traced.run.size();
      tracer_.go_round(traced, tracer_.steps_of(cycle));
      const std::size_t round = traced.run.size() - *finding.repeats;
      for (std::size_t i = 0; i < round; ++i)
        traced.run.push_back(traced.run[*finding.repeats + i]);
    }
    finding.run = std::move(traced.run);
  }

  std::vector<StateId> way_to_cycle(StateId from, const std::vector<CycleStep>& cycle) {
    std::vector<StateId> path{from};
    if (from == cycle.front().from) return path;
    std::vector<bool> is_goal(graph_.states());
    is_goal[cycle.front().from] = true;
    for (const CycleStep& it : shortest_path(graph_, from, is_goal)) path.push_back(it.edge.to);
    return path;
  }

  void look_for_cycles() {
    if (!models_.tree_ends) return;
    const EdgeFilter alive = [&](const Edge& edge) { return bool(can_end_[edge.to]); };
    const EdgeFilter alive_without_cuts = [&](const Edge& edge) {
      return alive(edge) && cuts_before(edge.to) == 0;
    };
    const auto answered = answer("always ends", [&] {
      if (can_end_.empty()) throw OutOfTime();  // it was not even known what can end
      auto cycle = fair_cycle(cycles_, alive_without_cuts);
      return cycle.empty() && models_.cuts.most > 0 ? fair_cycle(cycles_, alive) : cycle;
    });
    if (!answered) return;
    const std::vector<CycleStep>& cycle = *answered;
    if (cycle.empty()) {
      if (!found_.is_complete()) return;
      const bool has_trap = !verdict_.findings.empty();
      has_trap ? say("always ends", "NO: see 'can always end'") : say_good("always ends", "yes");
      return;
    }
    Finding finding{.name = std::string(kCycle), .message = {}};
    add_lasso(cycle.front().from, cycle, finding);
    finding.message = "it may never end: a cycle of ticks may repeat indefinitely";
    finding.more = explainer_.standstill_of(finding);
    finding.more.push_back(explainer_.what_happens(finding));
    say("always ends", "NO: a cycle of ticks may repeat indefinitely");
    verdict_.findings.push_back(std::move(finding));
  }

  // --- who is held -------------------------------------------------------------------------------

  void look_for_starvation() {
    for (std::size_t i = 0; i < held_.size() && !models_.tree_ends; ++i) {
      const NodeIndex child = held_[i].child;
      const auto hold = answer("held: " + tree_.path(child), [&] { return hold_of(i); });
      if (!hold || !hold->for_ever) continue;
      const auto& endless = hold->for_ever;
      Finding finding{.name = std::string(kStarvation) + tree_.path(child), .message = {}};
      finding.node = child;
      const StateId start = endless->cycle.front().from;
      add_lasso(found_.path_to(start), endless->cycle, finding,
                trail_for(child, endless->child, start));
      finding.message = fmt::format("{} may be held indefinitely by '{}'", at(child),
                                    tree_.labels[held_[i].holder].name);
      finding.more = explainer_.why_it_stands(finding);
      verdict_.findings.push_back(std::move(finding));
    }
  }

  // A run in which the child that is held when it comes to the state is this one.
  TracedPath trail_for(NodeIndex child, std::size_t held, StateId state) {
    if (!found_.symmetry.moves(child)) return tracer_.begin();
    TracedPath traced = tracer_.begin();
    tracer_.go(traced, found_.path_to(state));
    return tracer_.begin(found_.symmetry.exchange(traced.nodes[held_[held].child], child));
  }

  struct HoldOfChild {
    std::optional<std::uint64_t> longest;
    std::optional<Holds::Endless> for_ever;
  };

  // Those that may change places with it, with itself.
  std::vector<std::size_t> like(std::size_t held) const {
    const auto is_like = [&](std::size_t other) {
      return found_.symmetry.first_like(held_[other].child) ==
             found_.symmetry.first_like(held_[held].child);
    };
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < held_.size(); ++i) {
      if (i == held || (found_.symmetry.moves(held_[held].child) && is_like(i))) found.push_back(i);
    }
    return found;
  }

  // One answer for all of them.
  const HoldOfChild& hold_of(std::size_t held) {
    const std::vector<std::size_t> all = like(held);
    if (const auto known = holds_.find(all.front()); known != holds_.end()) return known->second;
    HoldOfChild hold;
    const Holds holds(graph_, cycles_, all);
    hold.longest = holds.longest();
    // Without an end only where a cycle is.
    if (!hold.longest) hold.for_ever = holds.for_ever();
    return holds_.emplace(all.front(), std::move(hold)).first->second;
  }

  // Why it is not asked who is held for how long. Where that may be a finding, it always is.
  std::string_view too_much_for_holds(std::size_t held) const {
    // Of each state and each child that may be in its place.
    constexpr std::size_t kBytesOfFollowed = 300;
    if (!models_.tree_ends || holds_.contains(like(held).front())) return "";
    const std::size_t children = like(held).size();
    const std::size_t most = options_.memory - std::min(options_.memory, found_.memory());
    const bool is_much = children > 1 && found_.store.size() > most / kBytesOfFollowed / children;
    return is_much ? "--memory" : "";
  }

  void say_holds() {
    if (!found_.is_complete()) return;
    for (std::size_t i = 0; i < held_.size(); ++i) {
      const std::string name = "held: " + tree_.path(held_[i].child);
      if (const auto limit = too_much_for_holds(i); !limit.empty()) {
        say(name, not_known(limit));
        continue;
      }
      const auto hold = in_time([&] { return hold_of(i); });
      if (!hold) {
        if (models_.tree_ends) say(name, not_known("--time"));
      } else if (!hold->longest) {
        say(name, hold->for_ever ? "may be held indefinitely" : "as long as others take");
      } else {
        say(name, *hold->longest == 0 ? "never"
                                      : fmt::format("at most {}", counted(*hold->longest, "tick")));
      }
    }
  }

  // --- nodes -------------------------------------------------------------------------------------

  void look_for_dead_nodes() {
    if (!found_.is_complete()) return;
    std::vector<std::string> names;
    for (NodeIndex node = 0; node < tree_.nodes[0].end;) {
      if (found_.coverage.was_ticked(node)) {
        ++node;
        continue;
      }
      names.push_back(at(node));
      verdict_.findings.push_back({.name = std::string(kNeverTicked) + tree_.path(node),
                                   .message = at(node) + " is never ticked",
                                   .node = node});
      node = tree_.nodes[node].end;
    }
    names.empty() ? say_good("never ticked", "none")
                  : say("never ticked", some_of(names, kMostNamesInLine));
  }

  void look_at_violations() {
    for (const auto& [node, fault] : found_.faults) {
      verdict_.findings.push_back(
          {.name = std::string(kFault) + tree_.path(node),
           .message = fmt::format("a fault is reachable after {}: {} {}",
                                  counted(fault.second.ticks, "tick"), at(node), fault.first),
           .node = node,
           .run = run_to(fault.second)});
    }
    if (found_.broken) {
      verdict_.findings.push_back(
          {.name =
               std::string(kOrder) + found_.broken->first.substr(0, found_.broken->first.find(':')),
           .message = "an order of calls that the contract forbids, which is a bug in lockstep: " +
                      found_.broken->first,
           .run = run_to(found_.broken->second)});
    }
    for (const auto& [node, passed] : found_.passed) {
      verdict_.findings.push_back(
          {.name = std::string(kBarrierPassed) + tree_.path(node),
           .message =
               fmt::format("a barrier of {} is passed before all have reached it, which is a "
                           "bug in lockstep: {}",
                           at(node), passed.first),
           .node = node,
           .run = run_to(passed.second)});
    }
    for (const auto& [node, where] : found_.repeated) {
      verdict_.findings.push_back(
          {.name = std::string(kDoneTwice) + tree_.path(node),
           .message = fmt::format("{} starts again after a cut, though it may have succeeded in "
                                  "the tick that was lost. With on_resume=\"failure\", the tree "
                                  "decides; or its type keeps state, and is asked",
                                  at(node)),
           .node = node,
           .run = run_to(where)});
    }
    for (std::size_t i = 0; i < properties_.size(); ++i) look_at_property(i);
  }

  // One that waits for something is also violated by a run that goes on for ever without it.
  void look_at_property(std::size_t number) {
    const std::string& name = properties_[number].name();
    Finding finding{.name = name_of_finding(properties_[number]), .message = {}};
    if (const auto it = found_.violated.find(number); it != found_.violated.end()) {
      finding.run = run_to(it->second);
      finding.message = fmt::format("property '{}' is violated after {}", name,
                                    counted(it->second.ticks, "tick"));
      finding.more.push_back(explainer_.last_tick_of(finding));
    } else {
      const std::size_t bit = cycles_.shape.owed_bit(number);
      const auto answered = answer(fmt::format("property '{}'", name), [&] {
        return fair_cycle(cycles_, [&](const Edge& edge) { return cycles_.has(edge, bit); });
      });
      if (!answered) return;
      const std::vector<CycleStep>& cycle = *answered;
      if (cycle.empty()) {
        if (found_.is_complete()) say_good(fmt::format("property '{}'", name), "holds");
        return;
      }
      add_lasso(cycle.front().from, cycle, finding);
      finding.message = fmt::format(
          "property '{}' may never be decided: a cycle of ticks may repeat indefinitely", name);
    }
    say(fmt::format("property '{}'", name), "NO");
    verdict_.findings.push_back(std::move(finding));
  }

  void say_coverage() {
    if (!found_.is_complete()) return;
    std::vector<std::string> no_success, no_failure, no_timeout;
    for (NodeIndex node = 0; node < tree_.nodes[0].end; ++node) {
      if (!found_.coverage.was_ticked(node)) continue;
      const bool is_timeout = tree_.labels[node].type->limits_time;
      if (is_timeout && !found_.coverage.has_fired(node)) no_timeout.push_back(at(node));
      if (!found_.coverage.has_been(node, Status::Success)) no_success.push_back(tree_.path(node));
      if (!found_.coverage.has_been(node, Status::Failure)) no_failure.push_back(tree_.path(node));
    }
    say_or_none("never succeeds", no_success);
    say_or_none("never fails", no_failure);
    if (!no_timeout.empty()) say("Timeouts that never fire", some_of(no_timeout, kMostNamesInLine));
    for (const auto& it : found_.coverage.synchronized()) say_spread(it);
  }

  // The bound is what a spread is to be compared with: a step of a tick may come to it.
  std::string bound_of(NodeIndex node) const {
    if (const auto own = delta(tree_, node)) return fmt::format(" (delta {:.6g})", *own);
    const auto list = barriers(tree_, node);
    if (!list) return "";
    double before = 0, widest = 0;
    for (const double barrier : *list) {
      widest = std::max(widest, barrier - before);
      before = barrier;
    }
    return fmt::format(" (barriers up to {:.6g} apart)", std::max(widest, 1 - before));
  }

  void say_spread(const SearchCoverage::Synchronized& it) {
    if (!found_.coverage.was_ticked(it.node) && !tree_.is_group(it.node)) return;
    const std::string name = tree_.path(it.node);
    say("largest spread of " + name, fmt::format("{:.6g}{}", it.largest_spread, bound_of(it.node)));
    const auto all = barriers(tree_, it.node);
    if (!all) return;
    std::vector<std::string> never;
    for (const double barrier : *all) {
      if (!it.limits.contains(barrier)) never.push_back(fmt::format("{:.6g}", barrier));
    }
    if (!never.empty())
      say("never the current barrier of " + name, some_of(never, kMostNamesInLine));
  }

  // --- cuts --------------------------------------------------------------------------------------

  void note_cuts() {
    if (models_.cuts.most == 0) return;
    for (Finding& finding : verdict_.findings) {
      tracer_.play(finding.run, [&](Stepper& stepper, Status, std::size_t tick) {
        if (!stepper.was_cut()) return;
        finding.cuts.push_back(tick);
        finding.more.push_back(
            fmt::format("before tick {}, {}", tick, cut_text(stepper.cut_leaves(), tree_)));
      });
    }
  }

  // --- the words of a verdict --------------------------------------------------------------------

  void accept() {
    std::vector<std::string> unused;
    for (const AcceptedFinding& it : models_.accepted) {
      bool is_used = false;
      for (Finding& finding : verdict_.findings) {
        if (!matches(it.finding, finding.name)) continue;
        finding.accepted = it.because;
        is_used = true;
      }
      if (!is_used) unused.push_back(it.finding);
    }
    if (found_.is_complete() && !unused.empty()) {
      say("accepted, but not found", some_of(unused, kMostNamesInLine));
    }
  }

  void assume() {
    verdict_.assumed = assumptions(tree_, models_, options_.rate, options_.paces);
    if (found_.store.keeps_hashes()) verdict_.assumed.push_back("no two states have the same hash");
  }

  const Tree& tree_;
  const LeafModels& models_;
  std::span<const Property> properties_;
  const SearchResult& found_;
  const Graph &graph_, &cycles_;
  const VerdictOptions& options_;
  const std::vector<Holdable> held_;
  Tracer tracer_;
  Explainer explainer_;
  std::vector<bool> can_end_;
  std::map<std::size_t, HoldOfChild> holds_;  // by the first child of those that are alike
  Verdict verdict_;
};

}  // namespace

bool Verdict::has_findings() const {
  return std::ranges::any_of(findings, [](const Finding& it) { return it.accepted.empty(); });
}

void Verdict::keep_only(std::span<const std::string> patterns) {
  std::erase_if(findings, [&](const Finding& finding) {
    const bool goes =
        std::ranges::none_of(patterns, [&](const auto& it) { return matches(it, finding.name); });
    left_out += goes && finding.accepted.empty();
    return goes;
  });
}

std::string name_of_finding(const Property& property) {
  return std::string(kPropertyFinding) + property.name();
}

std::vector<std::string> possible_findings(const Tree& tree, std::span<const Property> properties) {
  std::vector<std::string> names{std::string(kTrap), std::string(kTrapAfterCut),
                                 std::string(kCycle), std::string(kOrder),
                                 std::string(kPropertyFinding)};
  for (const std::string_view kind :
       {kStarvation, kNeverTicked, kFault, kBarrierPassed, kDoneTwice}) {
    names.emplace_back(kind);
    for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
      names.push_back(std::string(kind) + tree.path(node));
    }
  }
  for (const Property& it : properties) names.push_back(name_of_finding(it));
  return names;
}

bool may_mean_finding(std::string_view pattern, std::span<const std::string> possible) {
  const auto star = pattern.find('*');
  const std::string_view start = pattern.substr(0, star);
  return std::ranges::any_of(possible, [&](std::string_view it) {
    if (star == pattern.npos && !pattern.starts_with(kOrder)) return it == pattern;
    return it.starts_with(start) || (it.ends_with('/') && start.starts_with(it));
  });
}

Verdict make_verdict(const Tree& tree, const LeafModels& models,
                     std::span<const Property> properties, const SearchResult& found,
                     const VerdictOptions& options) {
  return VerdictMaker(tree, models, properties, found, options).make();
}

}  // namespace lockstep::host
