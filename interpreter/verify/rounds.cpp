#include "verify/rounds.h"

#include <utility>

namespace lockstep::host {
namespace {

constexpr std::size_t kMostKnown = 1'000'000;  // where entries count, there may be many

}  // namespace

void Rounds::begin_state() {
  root_ticks_ = 0;
  looks_ = false;
  if (known_.size() > 0) known_.clear();
  way_.clear();
  place_.clear();
}

void Rounds::begin_tick(std::size_t same) {
  looks_ = root_ticks_ >= few_ && known_.size() < kMostKnown;
  at_ = 0;
  while (!way_.empty() && way_.back().answers > same) {
    place_[way_.back().state].reset();
    way_.pop_back();
  }
}

Rounds::Found Rounds::add(std::span<const std::byte> state, Round round) {
  const auto [id, is_new] = known_.add(state);
  if (!is_new && !place_[id]) return Found::Known;
  if (!is_new) {
    loop_ = *place_[id];
    return Found::Loop;
  }
  round.state = id;
  place_.resize(known_.size());
  place_[id] = way_.size();
  way_.push_back(std::move(round));
  at_ = way_.size();
  return Found::New;
}

// The number of a round is that of the root's tick in front of it, from 1 on.
const Rounds::Round& Rounds::last_of(std::uint64_t rounds) const {
  return way_[loop_ + (rounds - 1 - loop_) % (way_.size() - loop_)];
}

}  // namespace lockstep::host
