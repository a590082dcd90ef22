#include "team/member.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep::host {
namespace {

// Of a program that says nonsense, nothing is heard.
bool is_sensible(const TeamWord& word) {
  constexpr double kLongestPeriod = 3600;
  return word.progress >= 0 && word.progress <= 1 && word.period >= 0 &&
         word.period <= kLongestPeriod && (word.round == 0 || word.passed < word.round);
}

// In one run, completed rounds are not taken back.
bool contradicts(const TeamWord& word, const TeamWord& before) {
  return word.passed < before.passed || word.declaration != before.declaration ||
         word.pool.declaration != before.pool.declaration;
}

}  // namespace

TeamMember::TeamMember(TeamDeclaration declaration, std::uint64_t run)
    : declaration_(std::move(declaration)), others_(declaration_.others.size()) {
  own_.run = run;
  own_.declaration = declaration_.hash;
  own_.period = to_seconds(declaration_.period);
}

void TeamMember::hear(std::size_t place, const TeamWord& word, Nanoseconds at) {
  Other& other = others_[place];
  if (!is_sensible(word)) {
    other.nonsense = at;
    return;
  }
  const auto is_of = [&](const std::optional<Run>& it) { return it && it->word.run == word.run; };
  if (is_of(other.last)) {
    if (word.number <= other.last->word.number) return;
    if (contradicts(word, other.last->word)) other.contested = at;
    other.last = Run{word, at};
  } else if (is_of(other.before)) {
    if (word.number <= other.before->word.number) return;
    // Both live: neither has taken the place of the other.
    other.contested = at;
    other.before = std::exchange(other.last, Run{word, at});
  } else {
    other.before = std::exchange(other.last, Run{word, at});
  }
}

void TeamMember::hear_own_name(const TeamWord& word, Nanoseconds at) {
  if (word.run != own_.run) own_name_heard_ = at;
}

bool TeamMember::is_contested(const Other& other, Nanoseconds now) const {
  return other.contested && now - *other.contested <= deadline_;
}

bool TeamMember::is_contested(std::size_t other) const {
  return is_contested(others_[other], now_);
}

TeamMember::Where TeamMember::where_of(const Other& other, Nanoseconds now) const {
  const bool is_nonsense = other.nonsense && now - *other.nonsense <= deadline_;
  if (!other.last) return is_nonsense ? Where::Nonsense : Where::Unheard;
  const TeamWord& word = other.last->word;
  if (is_contested(other, now)) return Where::Contested;
  const bool is_of_team = word.declaration == own_.declaration;
  // It has done so for ever, and may be switched off.
  if (is_of_team && own_.round != 0 && word.passed >= own_.round) return Where::Passed;
  if (now - other.last->at > deadline_) return is_nonsense ? Where::Nonsense : Where::Silent;
  if (!is_of_team) return Where::Stranger;
  if (own_.round == 0) return Where::NotBegun;
  return is_in_round(word) ? Where::InRound : Where::NotBegun;
}

bool TeamMember::is_in_round(const TeamWord& word) const {
  return word.is_in && word.round == own_.round;
}

void TeamMember::look(Nanoseconds now) {
  now_ = now;
  double slowest = own_.period;
  for (const Other& it : others_) {
    if (it.last) slowest = std::max(slowest, it.last->word.period);
  }
  const auto periods = [&](int count) { return from_seconds(count * slowest); };
  deadline_ = declaration_.deadline.count() != 0
                  ? std::max(declaration_.deadline, periods(kFewestPeriods))
                  : periods(kPeriodsOfSilence);
  is_contested_ = own_name_heard_ && now - *own_name_heard_ <= deadline_;
  const auto find_all = [&] {
    for (Other& it : others_) {
      it.known = {.where = where_of(it, now)};
      if (it.last) {
        it.known.age = now - it.last->at;
        it.known.run = it.last->word.run;
        it.known.number = it.last->word.number;
      }
      // Of one that is silent, what was heard last.
      const bool has_progress = it.known.where == Where::InRound ||
                                it.known.where == Where::Silent ||
                                it.known.where == Where::Nonsense;
      if (it.known.where == Where::Passed) it.known.progress = 1;
      if (has_progress && is_in_round(it.last->word)) it.known.progress = it.last->word.progress;
    }
  };
  find_all();
  const std::uint32_t before = own_.round;
  if (own_.is_in) own_.round == 0 ? join() : follow();
  if (own_.round != before) find_all();
}

// The earliest round of those that know one: who does it waits for this member.
void TeamMember::join() {
  if (is_contested_) return;
  std::uint32_t earliest = 0;
  for (const Other& it : others_) {
    if (!is_known(it.known.where)) return;
    const std::uint32_t round = it.last->word.round;
    if (round != 0 && (earliest == 0 || round < earliest)) earliest = round;
  }
  own_.round = std::max(earliest, 1u);
}

// A new process may have joined a later round than this one, where it had heard of others only. It
// never completes this one, so all go on in that.
void TeamMember::follow() {
  for (const Other& it : others_) {
    if (!is_known(it.known.where)) continue;
    const TeamWord& word = it.last->word;
    if (word.is_in && word.passed < own_.round) own_.round = std::max(own_.round, word.round);
  }
}

void TeamMember::set_own(bool is_in, double progress, End end) {
  if (end == End::Success && own_.round != 0) own_.passed = own_.round++;
  own_.is_in = is_in;
  own_.progress = is_in && std::isfinite(progress) ? std::clamp(progress, 0.0, 1.0) : 0.0;
}

void TeamMember::restore(const Memory& memory) {
  own_ = memory.own;
  others_ = memory.others;
  own_name_heard_ = memory.own_name_heard;
}

TeamWord TeamMember::word(const PoolWord& pool) {
  ++own_.number;
  own_.pool = pool;
  return own_;
}

}  // namespace lockstep::host
