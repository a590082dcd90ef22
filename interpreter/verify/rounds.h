// The rounds of a tick: a node of BehaviorTree.CPP may have the root ticked again in the same
// period, up to 10,000 times. Between two rounds a run is in a state, as between two ticks, and
// from equal ones the same follows. So a search follows one of them only. Example: a Retry without
// an end whose child fails at once, and an action beside it that succeeds, fails or runs. Each
// round has these three answers, and all rounds of a tick in which it runs are in one state.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/tree.h"
#include "verify/state_store.h"

namespace lockstep::host {

class Rounds {
 public:
  explicit Rounds(std::uint64_t few_root_ticks) : few_(few_root_ticks) {}

  struct Round {
    std::size_t answers;                  // how many the tick has given until here
    NodeIndex asks;                       // the node that wants another one
    std::vector<std::size_t> owing = {};  // the properties that an end here would violate
    StateId state = kNoState;
  };
  enum class Found : std::uint8_t {
    New,
    Known,  // another tick from here has been in this state, and what follows it is looked at
    Loop,   // this tick has been in it: it can go on so until there are too many rounds
  };

  // Ticks of another state follow.
  void begin_state();
  // The next tick gives the first `same` answers as the one before it.
  void begin_tick(std::size_t same);
  // Whether it is worth to look at the rounds of this tick: `add` is to be called for each.
  bool are_looked_at() const { return looks_; }
  void count(std::uint64_t root_ticks) { root_ticks_ += root_ticks; }

  // Whether the tick before it has been here: then there is nothing to add.
  bool is_on_way() const { return at_ < way_.size(); }
  void pass() { ++at_; }
  Found add(std::span<const std::byte> state, Round round);
  // After Found::Loop: where the loop begins, and the round behind the last one that there may be.
  const Round& loop() const { return way_[loop_]; }
  const Round& last_of(std::uint64_t rounds) const;

 private:
  const std::uint64_t few_;
  std::uint64_t root_ticks_ = 0;  // from this state
  bool looks_ = false;
  StateStore known_;
  std::vector<Round> way_;                         // the rounds of the last tick
  std::vector<std::optional<std::size_t>> place_;  // of each known state in it
  std::size_t at_ = 0;                             // of this tick
  std::size_t loop_ = 0;
};

}  // namespace lockstep::host
