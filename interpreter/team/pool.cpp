#include "team/pool.h"

#include <algorithm>

namespace lockstep::host {

TeamPool::TeamPool(const TeamDeclaration& declaration, std::uint64_t run)
    : declaration_(declaration), run_(run), robots_(declaration.others.size() + 1) {
  own_.declaration = declaration.pool_hash;
  waiting_.reserve(robots_.size() * kMostAsked);
}

bool TeamPool::ask(std::size_t place, ResourceSet set) {
  PoolWord::Ask& ask = own_.asks[place];
  asked_[place] = true;
  if (ask.number == 0 || ask.set != set) ask = {.number = ++last_number_, .set = set};
  if (ask.owns) took_[place] = true;
  return ask.owns;
}

void TeamPool::give_back(std::size_t place) {
  own_.asks[place] = {};
  took_[place] = false;
}

const TeamWord* TeamPool::trusted(const TeamMember& team, std::size_t other) const {
  const TeamWord* const word = team.heard(other);
  const bool is_trusted = word != nullptr && !team.is_contested(other) &&
                          (word->pool.declaration == own_.declaration || takes_no_part(*word));
  return is_trusted ? word : nullptr;
}

void TeamPool::look(const TeamMember& team, Nanoseconds now) {
  asked_.fill(false);
  if (own_.declaration == 0 || team.is_contested()) return;
  find_decider(team);
  if (!decides()) return follow(team);
  if (decides_in_ != own_.term) {
    decides_in_ = own_.term;
    std::ranges::fill(robots_, Robot());
  }
  for (std::size_t member = 0; member < robots_.size(); ++member) hear(team, member, now);
  decide();
  answer();
}

// Each word says which term it is, so it is enough to hear of it from anyone.
void TeamPool::find_decider(const TeamMember& team) {
  for (std::size_t other = 0; other < declaration_.others.size(); ++other) {
    const TeamWord* const word = trusted(team, other);
    if (word == nullptr || takes_no_part(*word) || word->pool.term <= own_.term) continue;
    if (word->pool.decider >= robots_.size()) continue;
    own_.term = word->pool.term;
    own_.decider = word->pool.decider;
    own_.follows = 0;
    own_.answer_count = 0;
  }
  if (!decides() && is_next(team)) {
    ++own_.term;
    own_.decider = static_cast<std::uint32_t>(declaration_.place);
  }
}

// The decider had left before it heard that it decides, and this one is the next that has not.
bool TeamPool::is_next(const TeamMember& team) const {
  const TeamWord* const decider = trusted(team, other_of(own_.decider));
  if (decider == nullptr) return false;
  const bool has_left = decider->pool.has_left && decider->pool.term < own_.term;
  if (!has_left && !takes_no_part(*decider)) return false;
  for (std::size_t i = 1; i < robots_.size(); ++i) {
    const std::size_t member = (own_.decider + i) % robots_.size();
    if (member == declaration_.place) return true;
    const TeamWord* const word = trusted(team, other_of(member));
    if (word == nullptr || (!word->pool.has_left && !takes_no_part(*word))) return false;
  }
  return false;
}

void TeamPool::follow(const TeamMember& team) {
  const TeamWord* const word = trusted(team, other_of(own_.decider));
  if (word == nullptr || takes_no_part(*word) || word->pool.term != own_.term) return;
  own_.follows = word->run;
  for (std::size_t i = 0; i < word->pool.answer_count; ++i) {
    const PoolWord::Answer& answer = word->pool.answers[i];
    if (answer.run != run_ || answer.number == 0) continue;
    const auto ask = std::ranges::find(own_.asks, answer.number, &PoolWord::Ask::number);
    if (ask != own_.asks.end()) ask->owns = true;
  }
}

void TeamPool::hear(const TeamMember& team, std::size_t member, Nanoseconds now) {
  Robot& robot = robots_[member];
  if (member == declaration_.place) {
    robot.run = run_;
    robot.follows = robot.is_reachable = true;
    for (std::size_t i = 0; i < kMostAsked; ++i) note(robot.asks[i], own_.asks[i]);
    return;
  }
  robot.is_reachable = false;
  const TeamWord* const word = trusted(team, other_of(member));
  if (word == nullptr) return;  // what it owned, it may own still
  if (robot.run != 0 && robot.run != word->run && !robot.has_left) {
    if (robot.next != word->run) robot.next = word->run, robot.next_since = now;
    if (now - robot.next_since <= team.deadline()) return;
  }
  if (robot.run != word->run) robot = {.run = word->run};
  robot.has_left = word->pool.has_left || takes_no_part(*word);
  robot.follows = robot.has_left || word->pool.follows == run_;
  if (!robot.follows) return;
  robot.is_reachable = !team.is_silent(other_of(member));
  for (std::size_t i = 0; i < kMostAsked; ++i) note(robot.asks[i], word->pool.asks[i]);
}

void TeamPool::note(Ask& ask, const PoolWord::Ask& said) {
  if (ask.said.number != said.number) ask.since = ++asks_heard_;
  if (ask.granted != said.number || said.owns) ask.granted = 0;
  ask.said = said;
}

// Those that have waited longest first. What they wait for, no other robot gets before, unless
// they wait for that robot: it may need more to give back what it owns.
void TeamPool::decide() {
  if (!std::ranges::all_of(robots_, &Robot::follows)) return;
  waiting_.clear();
  for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
    if (!robots_[robot].is_reachable) continue;
    for (std::size_t place = 0; place < kMostAsked; ++place) {
      const Ask& ask = robots_[robot].asks[place];
      if (ask.said.number != 0 && !ask.said.owns && ask.granted == 0)
        waiting_.push_back({ask.since, robot, place});
    }
  }
  std::ranges::sort(waiting_, {}, &Waiting::since);
  for (auto it = waiting_.begin(); it != waiting_.end(); ++it) {
    Ask& ask = robots_[it->robot].asks[it->place];
    ResourceSet by_others = 0;
    for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
      if (robot != it->robot) by_others |= owned_by(robot);
    }
    const ResourceSet own = owned_by(it->robot);
    for (auto before = waiting_.begin(); before != it; ++before) {
      const ResourceSet wanted = robots_[before->robot].asks[before->place].said.set;
      if (before->robot != it->robot && (wanted & own) == 0) by_others |= wanted;
    }
    if ((by_others & ask.said.set) == 0) grant(it->robot, ask);
  }
}

ResourceSet TeamPool::owned_by(std::size_t robot) const {
  ResourceSet set = 0;
  for (const Ask& it : robots_[robot].asks) {
    if (it.said.owns || it.granted != 0) set |= it.said.set;
  }
  return set;
}

void TeamPool::grant(std::size_t member, Ask& ask) {
  if (member != declaration_.place) {
    ask.granted = ask.said.number;
    return;
  }
  std::ranges::find(own_.asks, ask.said.number, &PoolWord::Ask::number)->owns = true;
  ask.said.owns = true;
}

void TeamPool::answer() {
  own_.answer_count = 0;
  for (const Robot& robot : robots_) {
    for (const Ask& ask : robot.asks) {
      if (ask.granted == 0 || own_.answer_count == own_.answers.size()) continue;
      own_.answers[own_.answer_count++] = {.run = robot.run, .number = ask.granted};
    }
  }
}

void TeamPool::end_tick() {
  for (std::size_t place = 0; place < kMostAsked; ++place) {
    if (!asked_[place] && !took_[place]) give_back(place);
  }
}

// The next one of the list decides from now on, best one that is there.
void TeamPool::leave() {
  for (std::size_t place = 0; place < kMostAsked; ++place) give_back(place);
  own_.has_left = true;
  own_.answer_count = 0;
  if (!decides()) return;
  const auto grade = [&](std::size_t member) {
    const Robot& robot = robots_[member];
    return robot.run == 0 || robot.has_left ? 0 : robot.is_reachable ? 2 : 1;
  };
  const std::size_t own = declaration_.place;
  std::size_t next = (own + 1) % robots_.size();
  for (std::size_t i = 2; i < robots_.size(); ++i) {
    const std::size_t member = (own + i) % robots_.size();
    if (grade(member) > grade(next)) next = member;
  }
  ++own_.term;
  own_.decider = static_cast<std::uint32_t>(next);
}

void TeamPool::restore(const Memory& memory) {
  own_ = memory.own;
  took_ = memory.took;
  last_number_ = memory.last_number;
  decides_in_ = memory.decides_in;
  robots_ = memory.robots;
  asks_heard_ = memory.asks_heard;
}

TeamPool::Obstacle TeamPool::obstacle(const TeamMember& team, std::size_t place) const {
  using What = Obstacle::What;
  const ResourceSet wanted = own_.asks[place].set;
  const std::size_t others = declaration_.others.size();
  for (std::size_t other = 0; other < others; ++other) {
    const TeamWord* const word = team.heard(other);
    if (word == nullptr || word->pool.declaration != own_.declaration) continue;
    for (const PoolWord::Ask& it : word->pool.asks) {
      if (it.owns && (it.set & wanted) != 0) return {What::Owned, other, it.set & wanted};
    }
  }
  for (std::size_t member = 0; member <= others; ++member) {
    if (member == declaration_.place) continue;
    const std::size_t other = other_of(member);
    const bool is_needed = decides() ? !robots_[member].follows : member == own_.decider;
    if (!is_needed) continue;
    const TeamWord* const word = team.heard(other);
    if (word == nullptr) return {What::Unheard, other, 0};
    if (team.is_contested(other)) return {What::Contested, other, 0};
    if (word->pool.declaration != own_.declaration) return {What::Stranger, other, 0};
    if (team.is_silent(other)) return {What::Silent, other, 0};
  }
  for (std::size_t other = 0; other < others; ++other) {
    const TeamWord* const word = team.heard(other);
    if (word == nullptr || word->pool.declaration != own_.declaration) continue;
    for (const PoolWord::Ask& it : word->pool.asks) {
      if (it.number != 0 && (it.set & wanted) != 0) return {What::Wanted, other, it.set & wanted};
    }
  }
  return {};
}

}  // namespace lockstep::host
