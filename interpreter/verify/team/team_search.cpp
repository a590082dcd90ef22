#include "verify/team/team_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/core/resource_set.h"
#include "base/core/wording.h"
#include "verify/components.h"

namespace lockstep::host {
namespace {

// So many transitions are between two looks at limits.
constexpr std::uint64_t kOften = 1024;

}  // namespace

// The states and what each turn leads to.
struct TeamSearch::Graph {
  struct Edge {
    StateId to;
  };
  std::vector<Edge> edges = {};
  std::vector<std::size_t> begins = {0};  // of each state that was looked at, and the end
  std::vector<StateId> found_from = {};
  std::vector<bool> ends = {};  // all robots have ended

  std::size_t states() const { return found_from.size(); }
  std::size_t expanded() const { return begins.size() - 1; }
  std::span<const Edge> edges_of(StateId state) const {
    if (state >= expanded()) return {};
    return std::span(edges).subspan(begins[state], begins[state + 1] - begins[state]);
  }
  // Of each state: some path leads to an end, or to a state that was not looked at.
  std::vector<bool> can_end() const {
    std::vector<std::uint32_t> count(states() + 1);
    for (const Edge& it : edges) ++count[it.to + 1];
    for (std::size_t i = 1; i < count.size(); ++i) count[i] += count[i - 1];
    std::vector<StateId> from(edges.size());
    std::vector<std::uint32_t> at = count;
    for (StateId state = 0; state < expanded(); ++state) {
      for (const Edge& it : edges_of(state)) from[at[it.to]++] = state;
    }
    std::vector<bool> can(states());
    std::vector<StateId> next;
    const auto add = [&](StateId state) {
      if (can[state]) return;
      can[state] = true;
      next.push_back(state);
    };
    for (StateId state = 0; state < states(); ++state) {
      if (ends[state] || state >= expanded()) add(state);
    }
    while (!next.empty()) {
      const StateId state = next.back();
      next.pop_back();
      for (std::uint32_t i = count[state]; i < count[state + 1]; ++i) add(from[i]);
    }
    return can;
  }
};

TeamSearch::TeamSearch(std::vector<TeamTree> trees, double rate, std::uint32_t late, bool must_end,
                       const SearchLimits& limits)
    : trees_(std::move(trees)),
      rate_(rate),
      must_end_(must_end),
      limits_(limits),
      graph_(std::make_unique<Graph>()) {
  for (const TeamTree& it : trees_) {
    TeamNames& names = names_.emplace_back(TeamNames{.teams = it.teams, .others = {}, .asks = {}});
    for (const TeamDeclaration& team : it.teams) {
      auto& others = names.others.emplace_back(team.others.size());
      for (std::size_t i = 0; i < others.size(); ++i) {
        for (std::size_t robot = 0; robot < trees_.size(); ++robot) {
          const auto& theirs = trees_[robot].teams;
          const auto found = std::ranges::find_if(theirs, [&](const TeamDeclaration& other) {
            return other.team == team.team && other.self == team.others[i];
          });
          if (found != theirs.end())
            others[i] = TeamLink{robot, static_cast<std::size_t>(found - theirs.begin())};
        }
      }
      std::size_t asks = 0;
      for (const RobotLeaf& leaf : robot_leaves(it.tree)) {
        if (leaf.asks && leaf.team == team.team) asks = std::max(asks, leaf.place + 1);
      }
      names.asks.push_back(asks);
    }
  }
  const Nanoseconds period = from_seconds(1 / rate);
  code_.emplace(names_, period, late);
  for (const TeamNames& names : names_) {
    auto& deadlines = deadlines_.emplace_back();
    for (const TeamDeclaration& it : names.teams) {
      deadlines.push_back(it.deadline.count() == 0
                              ? kPeriodsOfSilence
                              : std::max<std::int64_t>(kFewestPeriods, it.deadline / period));
      may_be_silent_ |= late + 1 > deadlines.back();
    }
  }
  for (std::size_t robot = 0; robot < trees_.size(); ++robot) {
    const TeamTree& it = trees_[robot];
    robots_.push_back(std::make_unique<SearchedRobot>(it.tree, it.models, it.properties,
                                                      names_[robot], robot, rate));
  }
}

TeamSearch::~TeamSearch() = default;

std::optional<double> TeamSearch::begin_of(const std::vector<TeamTurn>& run,
                                           std::size_t robot) const {
  const auto begins = [&](const TeamTurn& it) { return it.robot == robot && it.begins; };
  const auto it = std::ranges::find_if(run, begins);
  if (it == run.end()) return std::nullopt;
  return static_cast<double>((it - run.begin()) / static_cast<std::ptrdiff_t>(names_.size())) /
         rate_;
}

TeamSearchResult TeamSearch::search() {
  began_ = monotonic_now();
  result_.results.resize(robots_.size());
  for (const TeamTree& it : trees_) result_.owes.emplace_back(it.properties.size());
  std::vector<std::byte> bytes;
  for (std::uint32_t order = 0; order < code_->orders().size(); ++order) {
    TeamState first = code_->first();
    first.order = order;
    code_->encode(std::move(first), bytes);
    graph_->found_from.push_back(store_.add(bytes).first);  // from itself
    graph_->ends.push_back(false);
  }
  for (StateId id = 0; id < store_.size() && !is_full() && !is_stopped(); ++id) {
    const TeamState from = code_->decode(store_[id]);
    const auto visit = [&](TeamState&& next, const TeamTurn& turn) {
      ++result_.transitions;
      look({id, from, turn}, next);
      const bool ends = std::ranges::all_of(next.robots, &RobotState::has_ended);
      code_->encode(std::move(next), bytes);
      const auto [to, is_new] = store_.add(bytes);
      graph_->edges.push_back({to});
      if (is_new) {
        graph_->found_from.push_back(id);
        graph_->ends.push_back(ends);
      }
      return result_.transitions % kOften != 0 || !is_stopped();
    };
    if (!graph_->ends[id] && !expand(from, visit)) break;  // it is one that was not looked at
    graph_->begins.push_back(graph_->edges.size());
  }
  graph_->edges.resize(graph_->begins.back());
  result_.states = store_.size();
  result_.periods = periods_to(static_cast<StateId>(store_.size() - 1));
  for (std::size_t i = 0; i < result_.findings.size(); ++i) {
    auto& run = result_.findings[i].run;
    const auto before = run_to(shown_by_[i]);
    run.insert(run.begin(), before.begin(), before.end());
  }
  if (must_end_) find_trap();
  result_.took = monotonic_now() - began_;
  return result_;
}

bool TeamSearch::is_full() {
  const bool is = store_.size() > limits_.states;
  if (is) result_.end = SearchEnd::States;
  return is;
}

bool TeamSearch::is_stopped() {
  if (result_.transitions < looks_at_) return false;
  looks_at_ = result_.transitions + kOften;
  const auto stop = [&](SearchEnd end) {
    result_.end = end;
    return true;
  };
  const std::size_t memory = store_.memory() + graph_->edges.size() * sizeof graph_->edges[0] +
                             graph_->states() * kLaterBytesOfState;
  if (memory > limits_.memory) return stop(SearchEnd::Memory);
  const Nanoseconds now = monotonic_now();
  if (limits_.time && now - began_ > *limits_.time) return stop(SearchEnd::Time);
  if (limits_.stop_signal && (result_.signal = limits_.stop_signal()) != 0)
    return stop(SearchEnd::Signal);
  constexpr std::chrono::milliseconds kTells(100);
  if (limits_.tell && now - told_ > kTells) {
    told_ = now;
    limits_.tell({.states = store_.size(),
                  .waiting = store_.size() - graph_->expanded(),
                  .transitions = result_.transitions,
                  .depth = periods_to(static_cast<StateId>(graph_->expanded())),
                  .memory = memory});
  }
  return false;
}

// Of the run that has found it.
std::uint32_t TeamSearch::periods_to(StateId state) const {
  std::size_t turns = 0;
  for (; graph_->found_from[state] != state; state = graph_->found_from[state]) ++turns;
  return static_cast<std::uint32_t>((turns + robots_.size() - 1) / robots_.size());
}

// --- one turn -----------------------------------------------------------------------------------

// False: `visit` wants no more.
bool TeamSearch::expand(const TeamState& from, const Visit& visit) {
  TeamTurn turn{.robot = code_->robot_of(from)};
  const RobotState& robot = from.robots[turn.robot];
  if (!robot.runs() && !visit(after_turn(from, turn, robot), turn)) return false;
  if (robot.has_ended()) return true;
  turn.ticks = true;
  turn.begins = !robot.runs();
  for (auto& heard : deliveries(from)) {
    turn.hears = std::move(heard);
    for (auto& silent : silences(from, turn)) {
      turn.silent = std::move(silent);
      if (!tick(from, turn, visit)) return false;
    }
  }
  return true;
}

bool TeamSearch::tick(const TeamState& from, TeamTurn& turn, const Visit& visit) {
  SearchedRobot& robot = *robots_[turn.robot];
  begin_turn(from, turn);
  do {
    RobotState after = robot.tick();
    turn.answers = robot.stepper().answers().asked();
    if (!visit(after_turn(from, turn, std::move(after)), turn)) return false;
  } while (robot.next());
  return true;
}

void TeamSearch::begin_turn(const TeamState& from, const TeamTurn& turn) {
  RobotState state = from.robots[turn.robot];
  for (const TeamTurn::Hears& it : turn.hears) state.teams[it.team].ages[it.other] = it.age;
  // A period has passed since its last turn.
  for (TeamPart& part : state.teams) {
    for (auto& other : part.member.others) {
      if (other.last) other.last->at -= from_seconds(1 / rate_);
    }
  }
  for (const TeamTurn::Silent& it : turn.silent)
    state.teams[it.team].member.others[it.other].last->at -= almost(from_seconds(1 / rate_));
  robots_[turn.robot]->begin_turn(state, turn.begins, words(from, turn));
}

std::vector<HeardWord> TeamSearch::words(const TeamState& from, const TeamTurn& turn) const {
  std::vector<HeardWord> heard;
  for (const TeamTurn::Hears& it : turn.hears) {
    const TeamLink link = *names_[turn.robot].others[it.team][it.other];
    TeamWord word = from.robots[link.robot].said[it.age][link.team];
    word.number = 2;  // newer than the one that was heard last
    heard.push_back({.team = static_cast<std::uint32_t>(it.team),
                     .member = static_cast<std::uint32_t>(it.other),
                     .word = word,
                     .at = TeamCode::kNow});
  }
  return heard;
}

// Each choice of those that may be silent already; of too many, all or none.
std::vector<std::vector<TeamTurn::Silent>> TeamSearch::silences(const TeamState& from,
                                                                const TeamTurn& turn) {
  constexpr std::size_t kMost = 6;
  std::vector<TeamTurn::Silent> may;
  const RobotState& robot = from.robots[turn.robot];
  for (std::size_t team = 0; team < robot.teams.size(); ++team) {
    const auto& others = robot.teams[team].member.others;
    for (std::size_t other = 0; other < others.size(); ++other) {
      const bool hears = std::ranges::any_of(
          turn.hears, [&](const auto& it) { return it.team == team && it.other == other; });
      if (!others[other].last || hears) continue;
      const Nanoseconds age = TeamCode::kNow - others[other].last->at + from_seconds(1 / rate_);
      if (age / from_seconds(1 / rate_) == deadlines_[turn.robot][team])
        may.push_back({team, other});
    }
  }
  if (may.size() > kMost) {
    result_.leaves_out_silences = true;
    return {{}, may};
  }
  std::vector<std::vector<TeamTurn::Silent>> all;
  for (std::size_t choice = 0; choice < std::size_t{1} << may.size(); ++choice) {
    auto& silent = all.emplace_back();
    for (std::size_t i = 0; i < may.size(); ++i) {
      if ((choice >> i & 1U) != 0) silent.push_back(may[i]);
    }
  }
  return all;
}

// All that the robot may have heard until now, of each other one the last word or none.
std::vector<std::vector<TeamTurn::Hears>> TeamSearch::deliveries(const TeamState& from) const {
  std::vector<std::vector<TeamTurn::Hears>> all(1);
  const std::size_t number = code_->robot_of(from);
  const RobotState& robot = from.robots[number];
  const TeamNames& names = names_[number];
  for (std::size_t team = 0; team < names.teams.size(); ++team) {
    for (std::size_t other = 0; other < names.others[team].size(); ++other) {
      const auto& link = names.others[team][other];
      if (!link) continue;
      const auto& said = from.robots[link->robot].said;
      const std::uint32_t known = robot.teams[team].ages[other];
      const auto& last = robot.teams[team].member.others[other].last;
      std::vector<std::uint32_t> may;
      bool must = false;
      // From the oldest one on: of words that are alike, the newest stands for all.
      const TeamWord* before = last ? &last->word : nullptr;
      for (auto age = static_cast<std::uint32_t>(std::min<std::size_t>(known, said.size()));
           age-- > 0;) {
        if (said[age].empty()) continue;
        const TeamWord& word = said[age][link->team];
        const bool is_alike =
            !may_be_silent_ && before != nullptr && TeamCode::are_alike(*before, word);
        must |= age == code_->late() || (is_alike && may.empty());
        if (is_alike && !may.empty()) may.pop_back();
        may.push_back(age);
        before = &word;
      }
      if (may.empty()) continue;
      std::vector<std::vector<TeamTurn::Hears>> more;
      for (const auto& it : all) {
        if (!must) more.push_back(it);
        for (const std::uint32_t age : may) {
          more.push_back(it);
          more.back().push_back({team, other, age});
        }
      }
      all = std::move(more);
    }
  }
  return all;
}

// What it said is a turn older for all others.
TeamState TeamSearch::after_turn(const TeamState& from, const TeamTurn& turn,
                                 RobotState robot) const {
  TeamState next = from;
  if (!turn.ticks) {
    robot.said.insert(robot.said.begin(), std::vector<TeamWord>());
    robot.said.pop_back();
  }
  next.robots[turn.robot] = std::move(robot);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    for (std::size_t team = 0; team < names_[i].teams.size(); ++team) {
      for (std::size_t other = 0; other < names_[i].others[team].size(); ++other) {
        const auto& link = names_[i].others[team][other];
        if (!link || link->robot != turn.robot) continue;
        std::uint32_t& age = next.robots[i].teams[team].ages[other];
        age = std::min(age + 1, code_->late() + 1);
      }
    }
  }
  next.turn = static_cast<std::uint32_t>((from.turn + 1) % names_.size());
  return next;
}

// --- what must never be -------------------------------------------------------------------------

void TeamSearch::look(const Done& done, const TeamState& next) {
  const TeamTurn& turn = done.turn;
  const RobotState& robot = next.robots[turn.robot];
  if (turn.ticks) {
    if (robot.has_ended()) result_.results[turn.robot].insert(robot.phase);
    const SearchedRobot& searched = *robots_[turn.robot];
    if (const Fault* const fault = searched.stepper().ticker().fault()) {
      add_finding("fault." + name(turn.robot),
                  fmt::format("{}: '{}' {}", name(turn.robot),
                              trees_[turn.robot].tree.path(fault->node), fault->message),
                  done);
    }
    look_at_properties(done, robot.has_ended());
    look_at_barriers(done);
    look_at_resources(done, next);
    look_at_spread(next);
  }
  result_.may_all_succeed |= std::ranges::all_of(
      next.robots, [](const RobotState& it) { return it.phase == RobotState::Phase::Succeeded; });
}

void TeamSearch::look_at_properties(const Done& done, bool has_ended) {
  const std::size_t number = done.turn.robot;
  const Stepper& stepper = robots_[number]->stepper();
  const std::span<const Property> properties = trees_[number].properties;
  for (const std::size_t it : stepper.violated()) {
    add_finding(fmt::format("property/{}.{}", properties[it].name(), name(number)),
                fmt::format("property '{}' of {} is violated", properties[it].name(), name(number)),
                done);
  }
  if (has_ended) return;
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (stepper.owes(i)) result_.owes[number][i] = true;
  }
}

// It may only go on from a barrier where each other one was at it in this round.
void TeamSearch::look_at_barriers(const Done& done) {
  constexpr double kClearly = 1e-6;
  const TeamTurn& turn = done.turn;
  const SearchedRobot& robot = *robots_[turn.robot];
  for (std::size_t team = 0; team < robot.in_step().size(); ++team) {
    const auto& in_step = robot.in_step()[team];
    const SearchedRobot::Moved& moved = robot.moved()[team];
    if (!in_step || !moved.ticked) continue;
    result_.has_barriers |= !in_step->barriers.empty();
    for (const double barrier : in_step->barriers) {
      // At 0, children begin together.
      const bool ticks = in_step->ticks_at_barrier && barrier > 0;
      if (moved.from < (ticks ? barrier + kClearly : barrier)) continue;
      for (std::size_t i = 0; i < names_[turn.robot].others[team].size(); ++i) {
        const auto& link = names_[turn.robot].others[team][i];
        const TeamPart* const other =
            link ? &done.from.robots[link->robot].teams[link->team] : nullptr;
        const bool was_there =
            other != nullptr &&
            (other->member.own.passed >= moved.round ||
             (other->round == moved.round && other->reached > barrier - kClearly));
        if (was_there) continue;
        add_finding(
            "barrier-passed." + names_[turn.robot].teams[team].team,
            fmt::format("{} passes the barrier {} before {} has reached it", name(turn.robot),
                        barrier, names_[turn.robot].teams[team].others[i]),
            done);
      }
    }
  }
}

void TeamSearch::look_at_resources(const Done& done, const TeamState& next) {
  const auto owned = [&](std::size_t robot, std::size_t team) {
    ResourceSet set = 0;
    for (const PoolWord::Ask& it : next.robots[robot].teams[team].pool.own.asks)
      set |= it.owns ? it.set : 0;
    return set;
  };
  for (std::size_t robot = 0; robot < names_.size(); ++robot) {
    for (std::size_t team = 0; team < names_[robot].teams.size(); ++team) {
      const TeamDeclaration& own = names_[robot].teams[team];
      if (own.pool_hash == 0) continue;
      result_.has_pool = true;
      for (std::size_t i = 0; i < own.others.size(); ++i) {
        const auto& link = names_[robot].others[team][i];
        if (!link || link->robot < robot) continue;
        if (names_[link->robot].teams[link->team].pool_hash != own.pool_hash) continue;
        const ResourceSet both = owned(robot, team) & owned(link->robot, link->team);
        if (both == 0) continue;
        add_finding("two-owners." + own.team,
                    fmt::format("{} and {} both own {}", name(robot), name(link->robot),
                                to_text(both, own.resources)),
                    done);
      }
    }
  }
}

void TeamSearch::look_at_spread(const TeamState& next) {
  for (std::size_t robot = 0; robot < names_.size(); ++robot) {
    for (std::size_t team = 0; team < names_[robot].teams.size(); ++team) {
      if (!robots_[robot]->in_step()[team]) continue;
      const std::string& name = names_[robot].teams[team].team;
      auto spread = std::ranges::find(result_.spreads, name, &TeamSearchResult::Spread::team);
      if (spread == result_.spreads.end())
        spread = result_.spreads.insert(result_.spreads.end(), {.team = name});
      const TeamWord& own = next.robots[robot].teams[team].member.own;
      for (const auto& link : names_[robot].others[team]) {
        if (!link || !own.is_in) continue;
        const TeamWord& other = next.robots[link->robot].teams[link->team].member.own;
        if (!other.is_in || other.round != own.round) continue;
        spread->largest = std::max(spread->largest, std::abs(own.progress - other.progress));
      }
    }
  }
}

void TeamSearch::add_finding(std::string name, std::string message, const Done& done) {
  const bool is_known =
      std::ranges::any_of(result_.findings, [&](const TeamFinding& it) { return it.name == name; });
  if (is_known) return;
  // The run until then is found when the robots are free.
  result_.findings.push_back(
      {.name = std::move(name), .message = std::move(message), .run = {done.turn}});
  shown_by_.push_back(done.state);
}

// --- what the graph says ------------------------------------------------------------------------

std::vector<TeamTurn> TeamSearch::run_to(StateId state) {
  std::vector<StateId> path{state};
  while (graph_->found_from[path.back()] != path.back())
    path.push_back(graph_->found_from[path.back()]);
  std::ranges::reverse(path);
  std::vector<TeamTurn> run;
  std::vector<std::byte> bytes;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool is_missing =
        expand(code_->decode(store_[path[i - 1]]), [&](TeamState&& next, const TeamTurn& it) {
          code_->encode(std::move(next), bytes);
          if (!store_.is(path[i], bytes)) return true;
          run.push_back(it);
          return false;
        });
    if (is_missing) throw std::logic_error("an edge of a search is not there any more");
  }
  return run;
}

// From such a state, the runs go on to states that they do not leave: there it can be seen best.
void TeamSearch::find_trap() {
  const std::vector<bool> can_end = graph_->can_end();
  const auto first = std::ranges::find(can_end, false);
  if (first == can_end.end()) return;
  result_.can_always_end = false;
  std::vector<StateId> trapped;
  for (StateId id = 0; id < can_end.size(); ++id) {
    if (!can_end[id]) trapped.push_back(id);
  }
  Components components(*graph_);
  components.find(trapped, [](StateId, const Graph::Edge&) { return true; });
  std::vector<bool> leads_out(components.count());
  for (const StateId id : trapped) {
    for (const Graph::Edge& it : graph_->edges_of(id)) {
      if (components.of(it.to) != components.of(id)) leads_out[components.of(id)] = true;
    }
  }
  const auto last =
      std::ranges::find_if(trapped, [&](StateId id) { return !leads_out[components.of(id)]; });
  TeamFinding finding{.name = "deadlock", .message = {}};
  finding.run = run_to(*last);
  const std::size_t periods = (finding.run.size() + robots_.size() - 1) / robots_.size();
  finding.message =
      fmt::format("after {}, the team can no longer end, whatever the leaves and the network do",
                  counted(periods, "tick"));
  finding.more = waits_in(*last);
  result_.findings.push_back(std::move(finding));
}

std::vector<std::string> TeamSearch::waits_in(StateId state) {
  std::vector<std::string> lines;
  TeamState from = code_->decode(store_[state]);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const std::size_t turn = code_->robot_of(from);
    const RobotState& robot = from.robots[turn];
    TeamState after = from;
    std::string line = robot.has_ended() ? "has ended" : robot.runs() ? "" : "has not begun";
    // The last answers are those with which leaves run, where they may.
    expand(from, [&](TeamState&& next, const TeamTurn& it) {
      after = std::move(next);
      if (it.ticks && robot.runs()) line = robots_[turn]->why();
      return true;
    });
    lines.push_back(fmt::format("{}: {}", name(turn), line.empty() ? "runs" : line));
    from = std::move(after);
  }
  std::ranges::sort(lines);
  return lines;
}

void TeamSearch::play(const std::vector<TeamTurn>& run, const AfterTurn& after) {
  TeamState state = code_->first();
  std::vector<std::byte> bytes;
  for (const TeamTurn& turn : run) {
    SearchedRobot& robot = *robots_[turn.robot];
    TeamState next;
    if (turn.ticks) {
      begin_turn(state, turn);
      robot.give(turn.answers);
      next = after_turn(state, turn, robot.tick());
    } else {
      next = after_turn(state, turn, state.robots[turn.robot]);
    }
    after(turn, robot);
    code_->encode(std::move(next), bytes);
    state = code_->decode(bytes);
  }
}

}  // namespace lockstep::host
