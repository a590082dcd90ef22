#include "verify/team/team_state.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>
#include <tuple>

#include "verify/packed_numbers.h"

namespace lockstep::host {
namespace {

// Both read and write, so that one description of a state serves both.
class TeamWriter {
 public:
  static constexpr bool kReads = false;
  explicit TeamWriter(std::vector<std::byte>& into) : into_(into) {}

  template <class T>
  void number(const T& value) {
    put_number(into_, static_cast<std::uint64_t>(value));
  }
  void real(double& value) {
    const auto bits = std::bit_cast<std::array<std::byte, sizeof value>>(value);
    into_.insert(into_.end(), bits.begin(), bits.end());
  }

 private:
  std::vector<std::byte>& into_;
};

class TeamReader {
 public:
  static constexpr bool kReads = true;
  explicit TeamReader(std::span<const std::byte> from) : from_(from) {}

  template <class T>
  void number(T& value) {
    value = static_cast<T>(take_number(from_));
  }
  void real(double& value) {
    std::memcpy(&value, from_.data(), sizeof value);
    from_ = from_.subspan(sizeof value);
  }

 private:
  std::span<const std::byte> from_;
};

// Brings numbers, of which none is 0, to 1, 2, 3, ... in their order.
template <class T>
void rank(const std::vector<T*>& numbers) {
  std::vector<T> all;
  for (const T* it : numbers) all.push_back(*it);
  std::ranges::sort(all);
  const auto rest = std::ranges::unique(all);
  all.erase(rest.begin(), rest.end());
  for (T* it : numbers) *it = static_cast<T>(std::ranges::lower_bound(all, *it) - all.begin()) + 1;
}

// The words of a member of a team that anyone still knows.
template <class Visit>
void for_each_word(TeamState& state, std::span<const TeamNames> names, TeamLink of, Visit visit) {
  for (auto& said : state.robots[of.robot].said) {
    if (!said.empty()) visit(said[of.team]);
  }
  for (std::size_t robot = 0; robot < state.robots.size(); ++robot) {
    for (std::size_t team = 0; team < state.robots[robot].teams.size(); ++team) {
      auto& others = state.robots[robot].teams[team].member.others;
      for (std::size_t i = 0; i < others.size(); ++i) {
        const auto& link = names[robot].others[team][i];
        const bool is_of = link && link->robot == of.robot && link->team == of.team;
        if (is_of && others[i].last) visit(others[i].last->word);
      }
    }
  }
}

}  // namespace

TeamCode::TeamCode(std::span<const TeamNames> names, Nanoseconds period, std::uint32_t late)
    : names_(names), period_(period), late_(late) {
  for (std::size_t robot = 0; robot < names.size(); ++robot) {
    for (std::size_t team = 0; team < names[robot].teams.size(); ++team) {
      const std::string& name = names[robot].teams[team].team;
      const auto known = std::ranges::find_if(teams_, [&](const auto& it) {
        return names[it.front().robot].teams[it.front().team].team == name;
      });
      auto& members = known != teams_.end() ? *known : teams_.emplace_back();
      members.push_back({robot, team});
    }
  }
  for (std::size_t robot = 0; robot < names_.size(); ++robot) {
    RobotState& state = first_.robots.emplace_back();
    auto& words = words_.emplace_back();
    for (const TeamDeclaration& team : names_[robot].teams) {
      const TeamPart& part = state.teams.emplace_back(
          TeamPart{.member = TeamMember(team, run_of(robot)).memory(),
                   .pool = TeamPool(team, run_of(robot)).memory(),
                   .ages = std::vector<std::uint32_t>(team.others.size(), late_ + 1)});
      TeamWord& word = words.emplace_back(part.member.own);
      word.pool = part.pool.own;
      word.number = 1;
    }
    state.said.resize(late_ + 1);
  }
  std::vector<std::size_t> order(names_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  do {
    orders_.push_back(order);
  } while (order.size() <= kMostInAnyOrder &&
           std::next_permutation(order.begin() + 1, order.end()));
}

bool TeamCode::are_alike(const TeamWord& one, const TeamWord& other) {
  const auto all = [](const TeamWord& it) {
    return std::tie(it.round, it.passed, it.is_in, it.progress, it.pool.term, it.pool.decider,
                    it.pool.follows, it.pool.has_left);
  };
  const auto answers = [](const TeamWord& it) {
    return std::span(it.pool.answers).first(it.pool.answer_count);
  };
  return all(one) == all(other) && one.pool.asks == other.pool.asks &&
         std::ranges::equal(answers(one), answers(other));
}

void TeamCode::encode(TeamState&& state, std::vector<std::byte>& into) const {
  normalize(state);
  into.clear();
  into.reserve(512);
  TeamWriter writer(into);
  code(writer, state);
}

TeamState TeamCode::decode(std::span<const std::byte> from) const {
  TeamState state = first_;
  TeamReader reader(from);
  code(reader, state);
  return state;
}

template <class Coder>
void TeamCode::code(Coder& coder, TeamState& state) const {
  coder.number(state.order);
  coder.number(state.turn);
  for (std::size_t robot = 0; robot < names_.size(); ++robot)
    code(coder, state.robots[robot], names_[robot]);
}

template <class Coder>
void TeamCode::code(Coder& coder, RobotState& robot, const TeamNames& names) const {
  coder.number(robot.phase);
  if (robot.phase == RobotState::Phase::Waiting) return;
  if (robot.runs()) coder.number(robot.tree);
  for (std::size_t team = 0; team < names.teams.size(); ++team)
    code(coder, robot.teams[team], names, team);
  const auto self = static_cast<std::size_t>(&names - names_.data());
  for (auto& said : robot.said) {
    bool has_said = !said.empty();
    coder.number(has_said);
    if (!has_said) continue;
    for (std::size_t team = 0; team < names.teams.size(); ++team) {
      if (Coder::kReads) said.push_back(fresh_word({self, team}));
      code(coder, said[team], names.asks[team]);
    }
  }
}

template <class Coder>
void TeamCode::code(Coder& coder, TeamPart& part, const TeamNames& names, std::size_t team) const {
  TeamWord& own = part.member.own;
  coder.number(own.round);
  coder.number(own.passed);
  coder.number(own.is_in);
  coder.real(own.progress);
  coder.number(part.round);
  coder.real(part.reached);
  for (std::size_t i = 0; i < part.ages.size(); ++i) {
    auto& last = part.member.others[i].last;
    bool is_heard = last.has_value();
    coder.number(is_heard);
    if (!is_heard) continue;
    const TeamLink link = *names.others[team][i];
    if (Coder::kReads) last = TeamMember::Run{.word = fresh_word(link)};
    auto age = static_cast<std::uint64_t>((kNow - last->at) / period_);
    coder.number(age);
    last->at = kNow - static_cast<std::int64_t>(age) * period_;
    coder.number(part.ages[i]);
    code(coder, last->word, names_[link.robot].asks[link.team]);
  }
  if (names.teams[team].pool_hash == 0) return;
  TeamPool::Memory& pool = part.pool;
  TeamWord word;
  word.pool = pool.own;
  code(coder, word, names.asks[team]);
  pool.own = word.pool;
  coder.number(pool.last_number);
  for (std::size_t i = 0; i < names.asks[team]; ++i) coder.number(pool.took[i]);
  bool decides = pool.decides_in.has_value();
  coder.number(decides);
  if (!decides) return;
  if (Coder::kReads) pool.decides_in = pool.own.term;
  coder.number(pool.asks_heard);
  for (TeamPool::Robot& robot : pool.robots) {
    coder.number(robot.run);
    coder.number(robot.follows);
    coder.number(robot.has_left);
    for (std::size_t i = 0; i < kMostAsked; ++i) {
      TeamPool::Ask& ask = robot.asks[i];
      coder.number(ask.said.number);
      if (ask.said.number == 0) continue;
      coder.number(ask.said.owns);
      coder.number(ask.said.set);
      coder.number(ask.since);
      coder.number(ask.granted);
    }
  }
}

// Without what is the same in all words of a robot, and their numbers.
template <class Coder>
void TeamCode::code(Coder& coder, TeamWord& word, std::size_t asks) const {
  coder.number(word.round);
  coder.number(word.passed);
  coder.number(word.is_in);
  coder.real(word.progress);
  PoolWord& pool = word.pool;
  if (pool.declaration == 0) return;
  coder.number(pool.term);
  coder.number(pool.decider);
  coder.number(pool.follows);
  coder.number(pool.has_left);
  for (std::size_t i = 0; i < asks; ++i) {
    coder.number(pool.asks[i].number);
    if (pool.asks[i].number == 0) continue;
    coder.number(pool.asks[i].owns);
    coder.number(pool.asks[i].set);
  }
  coder.number(pool.answer_count);
  for (std::size_t i = 0; i < pool.answer_count; ++i) {
    coder.number(pool.answers[i].run);
    coder.number(pool.answers[i].number);
  }
}

// What no later turn reads is as in a new robot; see the numbers above.
void TeamCode::normalize(TeamState& state) const {
  for (std::size_t robot = 0; robot < state.robots.size(); ++robot) {
    RobotState& it = state.robots[robot];
    if (it.phase == RobotState::Phase::Waiting) it = first_.robots[robot];
    for (std::size_t team = 0; team < it.teams.size(); ++team) {
      TeamPart& part = it.teams[team];
      const TeamDeclaration& declaration = names_[robot].teams[team];
      if (it.has_ended()) part.member.others.assign(declaration.others.size(), {});
      const std::int64_t silent =
          std::max<std::int64_t>(kPeriodsOfSilence, declaration.deadline / period_) + 1;
      for (auto& other : part.member.others) {
        if (other.last) other.last->at = std::max(other.last->at, kNow - silent * period_);
      }
      TeamPool::Memory& pool = part.pool;
      const bool decides =
          pool.decides_in == pool.own.term && pool.own.decider == declaration.place;
      if (!decides || it.has_ended()) {
        pool.decides_in.reset();
        std::ranges::fill(pool.robots, TeamPool::Robot());
        pool.asks_heard = 0;
      }
      for (TeamPool::Robot& of : pool.robots) {
        of.is_reachable = false;
        for (TeamPool::Ask& ask : of.asks) {
          if (ask.said.number == 0) ask = {};
        }
      }
    }
  }
  for (const auto& team : teams_) {
    normalize_rounds(state, team);
    normalize_asks(state, team);
  }
}

void TeamCode::normalize_rounds(TeamState& state, std::span<const TeamLink> team) const {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  std::vector<TeamWord*> words;
  for (const TeamLink& it : team) {
    TeamWord& own = state.robots[it.robot].teams[it.team].member.own;
    words.push_back(&own);
    for_each_word(state, names_, it, [&](TeamWord& word) { words.push_back(&word); });
  }
  for (const TeamWord* it : words) least = std::min(least, it->passed);
  if (least == 0) return;
  for (TeamWord* it : words) it->passed -= least, it->round -= least;
  for (const TeamLink& it : team) {
    TeamPart& part = state.robots[it.robot].teams[it.team];
    if (part.round <= least) part.reached = 0;
    part.round -= std::min(part.round, least);
  }
}

void TeamCode::normalize_asks(TeamState& state, std::span<const TeamLink> team) const {
  std::vector<std::uint32_t*> numbers;
  const auto add = [&](std::uint32_t& number) {
    if (number != 0) numbers.push_back(&number);
  };
  for (const TeamLink& of : team) {
    if (names_[of.robot].teams[of.team].pool_hash == 0) continue;
    const std::size_t asks = names_[of.robot].asks[of.team];
    const auto add_asks = [&](PoolWord& word) {
      for (std::size_t i = 0; i < asks; ++i) add(word.asks[i].number);
    };
    const auto add_answers = [&](PoolWord& word) {
      for (std::size_t i = 0; i < word.answer_count; ++i) {
        if (word.answers[i].run == run_of(of.robot)) add(word.answers[i].number);
      }
    };
    numbers.clear();
    TeamPool::Memory& own = state.robots[of.robot].teams[of.team].pool;
    add_asks(own.own);
    add(own.last_number);
    for_each_word(state, names_, of, [&](TeamWord& it) { add_asks(it.pool); });
    for (const TeamLink& by : team) {
      TeamPool::Memory& pool = state.robots[by.robot].teams[by.team].pool;
      add_answers(pool.own);
      for_each_word(state, names_, by, [&](TeamWord& it) { add_answers(it.pool); });
      for (TeamPool::Robot& robot : pool.robots) {
        if (robot.run != run_of(of.robot)) continue;
        for (std::size_t i = 0; i < asks; ++i)
          add(robot.asks[i].said.number), add(robot.asks[i].granted);
      }
    }
    rank(numbers);
    std::vector<std::uint64_t*> since;
    for (TeamPool::Robot& robot : own.robots) {
      for (TeamPool::Ask& it : robot.asks) {
        if (it.since != 0) since.push_back(&it.since);
      }
    }
    rank(since);
    own.asks_heard = since.size();
  }
}

}  // namespace lockstep::host
