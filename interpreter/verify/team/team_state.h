// The state of a team between two turns of its robots, as bytes that can be compared. In each
// period, each robot has one turn: it hears words, and ticks its tree. The turns come in an order
// that does not change.
//
// Numbers that only grow are brought to the smallest ones with the same order: rounds of the team,
// asks for resources. So a team that works in a loop has finitely many states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "team/member.h"
#include "team/pool.h"
#include "verify/state_store.h"

namespace lockstep::host {

// Where words come from and go to, by the places of robots in the list, and of teams in each.
struct TeamLink {
  std::size_t robot = 0, team = 0;
};
struct TeamNames {
  std::vector<TeamDeclaration> teams;  // of the robot
  std::vector<std::vector<std::optional<TeamLink>>>
      others;                     // of each team; nothing: it has no tree
  std::vector<std::size_t> asks;  // of each team: how many nodes use its pool
};

// Of one robot, in one of its teams.
struct TeamPart {
  TeamMember::Memory member;
  TeamPool::Memory pool;
  // Of each other one: how many turns of it ago it said the word that was heard last, at most
  // one more than words may be late.
  std::vector<std::uint32_t> ages;
  // How far it has come in the round that it does, whether it was halted since or not.
  std::uint32_t round = 0;
  double reached = 0;
};

struct RobotState {
  enum class Phase : std::uint8_t { Waiting, Running, Succeeded, Failed, Skipped, Faulted };
  Phase phase = Phase::Waiting;  // it has not begun, or it has ended
  StateId tree = 0;              // the state of its tree, in a store of its own
  std::vector<TeamPart> teams = {};
  // What it said in its last turns, the newest first: nothing, or a word in each team.
  std::vector<std::vector<TeamWord>> said = {};

  bool runs() const { return phase == Phase::Running; }
  bool has_ended() const { return phase > Phase::Running; }
};

struct TeamState {
  std::vector<RobotState> robots = {};
  std::uint32_t order = 0;  // of turns: TeamCode::orders
  std::uint32_t turn = 0;   // the place in it
};

class TeamCode {
 public:
  // What is heard at `now` is new. `names` must outlive this. Words are at most `late` turns late.
  TeamCode(std::span<const TeamNames> names, Nanoseconds period, std::uint32_t late);

  static constexpr Nanoseconds kNow = std::chrono::hours(1);
  // The run of a robot, as its words have it.
  static std::uint64_t run_of(std::size_t robot) { return robot + 1; }

  const TeamState& first() const { return first_; }
  // The orders in which robots may have their turns, from the first robot on: all of them, or of
  // more robots than kMostInAnyOrder that of the list.
  static constexpr std::size_t kMostInAnyOrder = 5;
  const std::vector<std::vector<std::size_t>>& orders() const { return orders_; }
  std::size_t robot_of(const TeamState& state) const { return orders_[state.order][state.turn]; }
  void encode(TeamState&& state, std::vector<std::byte>& into) const;
  TeamState decode(std::span<const std::byte> from) const;
  std::uint32_t late() const { return late_; }
  // Whether all later words of its robot can be heard in the same ways after either of them.
  static bool are_alike(const TeamWord& one, const TeamWord& other);

 private:
  void normalize(TeamState& state) const;
  void normalize_rounds(TeamState& state, std::span<const TeamLink> team) const;
  void normalize_asks(TeamState& state, std::span<const TeamLink> team) const;
  template <class Coder>
  void code(Coder& coder, TeamState& state) const;
  template <class Coder>
  void code(Coder& coder, RobotState& robot, const TeamNames& names) const;
  template <class Coder>
  void code(Coder& coder, TeamPart& part, const TeamNames& names, std::size_t team) const;
  template <class Coder>
  void code(Coder& coder, TeamWord& word, std::size_t asks) const;
  const TeamWord& fresh_word(TeamLink of) const { return words_[of.robot][of.team]; }

  const std::span<const TeamNames> names_;
  const Nanoseconds period_;
  const std::uint32_t late_;
  std::vector<std::vector<TeamLink>> teams_;  // of the robots, the members of each
  std::vector<std::vector<TeamWord>> words_;  // the first ones
  TeamState first_;
  std::vector<std::vector<std::size_t>> orders_;
};

}  // namespace lockstep::host
