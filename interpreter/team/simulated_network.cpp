#include "team/simulated_network.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep::host {

Turns::Turns(std::size_t runs) : turns_(runs) {}

bool Turns::has_turn(std::size_t run) const {
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    if (i == run || turns_[i].is_over) continue;
    if (turns_[i].next < turns_[run].next || (i < run && turns_[i].next == turns_[run].next))
      return false;
  }
  return true;
}

void Turns::enter(std::size_t run, Nanoseconds begin) {
  wait(run, begin);
}

void Turns::wait(std::size_t run, Nanoseconds until) {
  std::unique_lock lock(mutex_);
  Turn& turn = turns_[run];
  turn.next = std::max(until, turn.now);
  changed_.notify_all();
  changed_.wait(lock, [&] { return has_turn(run); });
  turn.now = turn.next;
}

void Turns::leave(std::size_t run) {
  const std::scoped_lock lock(mutex_);
  turns_[run].is_over = true;
  changed_.notify_all();
}

Nanoseconds Turns::now(std::size_t run) {
  const std::scoped_lock lock(mutex_);
  return turns_[run].now;
}

class SimulatedNetwork::Link final : public TeamTransport {
 public:
  Link(SimulatedNetwork& network, std::vector<TeamDeclaration> teams, Clock& clock)
      : network_(network), teams_(std::move(teams)), last_(teams_.size()), clock_(clock) {}

  bool take(HeardWord& into) override {
    if (!std::exchange(has_begun_, true)) forget_gone();
    send_again();
    if (coming_.empty() || coming_.front().at > clock_.now()) return false;
    into = coming_.front();
    coming_.pop_front();
    return true;
  }
  void say(std::uint32_t team, const TeamWord& word) override {
    last_[team] = word;
    network_.say(*this, team, word);
  }

  const std::vector<TeamDeclaration>& teams() const { return teams_; }
  const TeamWord& last(std::size_t team) const { return last_[team]; }
  Nanoseconds now() const { return clock_.now(); }
  // A word of `from`. The one before it is not sent again any more.
  void send(const Link& from, HeardWord word) {
    std::erase_if(lost_,
                  [&](const Lost& it) { return it.from == &from && it.word.team == word.team; });
    word.at = from.now();
    if (!try_to_add(word)) lost_.push_back({&from, word});
  }
  void forget(const Link& from) {
    std::erase_if(lost_, [&](const Lost& it) { return it.from == &from; });
  }

 private:
  // A network has the last word of a robot that runs for who comes later, and nothing of one that
  // has ended.
  void forget_gone() {
    const auto is_of_one = [](const auto& from, const HeardWord& word) {
      return std::ranges::any_of(from, [&](const HeardWord& it) {
        return it.word.pool.has_left && it.team == word.team && it.member == word.member;
      });
    };
    const std::deque<HeardWord> all = coming_;
    std::erase_if(coming_, [&](const HeardWord& it) { return is_of_one(all, it); });
    std::erase_if(lost_, [](const Lost& it) { return it.word.word.pool.has_left; });
  }
  // What was lost is sent again after a time, as networks for robots do: the last word of each.
  void send_again() {
    constexpr Nanoseconds kAgain = std::chrono::milliseconds(100);
    std::erase_if(lost_, [&](Lost& it) {
      while (it.word.at + kAgain <= clock_.now()) {
        it.word.at += kAgain;
        if (try_to_add(it.word)) return true;
      }
      return false;
    });
  }
  bool try_to_add(HeardWord word) {
    const auto at = network_.arrival(word.at);
    if (!at) return false;
    word.at = *at;
    // Words may come in another order than they were said.
    coming_.insert(std::ranges::upper_bound(coming_, word.at, {}, &HeardWord::at), word);
    return true;
  }

  struct Lost {
    const Link* from;
    HeardWord word;  // `at`: when it was sent last
  };
  SimulatedNetwork& network_;
  const std::vector<TeamDeclaration> teams_;
  std::vector<TeamWord> last_;
  Clock& clock_;
  std::deque<HeardWord> coming_;
  bool has_begun_ = false;
  std::vector<Lost> lost_;
};

SimulatedNetwork::SimulatedNetwork(const NetworkOptions& options)
    : options_(options), random_(options.seed, 0) {}
SimulatedNetwork::~SimulatedNetwork() = default;

TeamTransport& SimulatedNetwork::join(const std::vector<TeamDeclaration>& teams, Clock& clock) {
  return *links_.emplace_back(std::make_unique<Link>(*this, teams, clock));
}

void SimulatedNetwork::leave(const TeamTransport& link) {
  for (const auto& it : links_) it->forget(static_cast<const Link&>(link));
  std::erase_if(links_, [&](const auto& it) { return it.get() == &link; });
}

void SimulatedNetwork::say(const Link& from, std::uint32_t team, const TeamWord& word) {
  const TeamDeclaration& own = from.teams()[team];
  measure(own);
  for (const auto& link : links_) {
    if (link.get() == &from) continue;
    for (std::uint32_t i = 0; i < link->teams().size(); ++i) {
      const TeamDeclaration& theirs = link->teams()[i];
      if (theirs.team != own.team) continue;
      const auto other = std::ranges::find(theirs.others, own.self);
      const bool is_same = theirs.self == own.self;
      if (other == theirs.others.end() && !is_same) continue;
      const auto place = static_cast<std::uint32_t>(other - theirs.others.begin());
      link->send(from, {.team = i, .member = is_same ? HeardWord::kOwnName : place, .word = word});
    }
  }
}

std::optional<Nanoseconds> SimulatedNetwork::arrival(Nanoseconds sent) {
  const Nanoseconds more = from_seconds(to_seconds(options_.jitter) * random_.next_double());
  const bool is_lost = random_.next_double() < options_.loss;
  const bool is_cut = std::ranges::any_of(
      options_.cuts, [&](const auto& it) { return it.from <= sent && sent < it.until; });
  if (is_lost || is_cut) return std::nullopt;
  return sent + options_.latency + more;
}

void SimulatedNetwork::measure(const TeamDeclaration& team) {
  std::vector<const TeamWord*> in;
  for (const auto& link : links_) {
    for (std::size_t i = 0; i < link->teams().size(); ++i) {
      if (link->teams()[i].team == team.team && link->last(i).is_in) in.push_back(&link->last(i));
    }
  }
  for (const TeamWord* one : in) {
    for (const TeamWord* other : in) {
      if (one->round != other->round) continue;
      largest_spread_ = std::max(largest_spread_, std::abs(one->progress - other->progress));
    }
  }
}

}  // namespace lockstep::host
