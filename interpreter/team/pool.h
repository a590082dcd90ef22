// A pool of resources that the robots of a team share: which of them one robot owns. This is the
// law of docs/team.md, as TeamMember is for rounds: without a network, a clock and a tree. One
// thread at a time; nothing allocates after the constructor.
//
// One member decides: the first of the list, until its run ends in order; then one that it names,
// in the next term. Each robot says what it owns and asks for, and that one answers. No resource
// ever has two owners:
//
//   A robot owns what it was granted from the tick in which it hears so until it says that it has
//   given it back. The decider counts what it has granted as owned until it hears that: delay, loss
//   and silence only make others wait.
//   An answer is for one ask of one process, and each robot takes answers from one process. A
//   process that begins to decide grants nothing before each other robot has said that it follows
//   it, and what it owns: then no robot takes an answer of an earlier one.
//   A new process of a robot owns nothing. What the old one owned is free when it was not heard for
//   the deadline, since two processes may live.
//
// Who has waited longest is first: what it waits for is granted to no other robot before. The
// exception is a robot for which it waits. For example, b waits for x, which a owns, and for y:
// then a gets y when it asks, because it may need y to give back x. Nodes of one robot never
// compete here: the pool in its tree has decided between them. A robot whose tree uses no pool of
// the team takes no part.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "team/member.h"

namespace lockstep::host {

class TeamPool {
 public:
  // The declaration must outlive this.
  TeamPool(const TeamDeclaration& declaration, std::uint64_t run);

  // In a tick, of the node with this number: whether it owns the set. While it does not, this is
  // called in each tick, and else the ask is taken back.
  bool ask(std::size_t place, ResourceSet set);
  // Its child does not run any more.
  void give_back(std::size_t place);

  // At the beginning of each tick, after `team` has looked.
  void look(const TeamMember& team, Nanoseconds now);
  // At the end of each tick.
  void end_tick();
  // The run ends: it gives back all, and decides no more.
  void leave();
  const PoolWord& word() const { return own_; }
  bool waits(std::size_t place) const {
    return own_.asks[place].number != 0 && !own_.asks[place].owns;
  }

  // Why a node does not get what it asks for, now.
  struct Obstacle {
    enum class What : std::uint8_t {
      None,       // it was only asked for
      Owned,      // by another robot
      Wanted,     // by another robot, too, which may have waited longer
      Unheard,    // the decider, or by the decider: it has not been heard yet
      Silent,     // the decider is
      Contested,  // the same: two robots have its name, or it contradicts itself
      Stranger,   // the same: its tree declares the pool in another way
    };
    What what = What::None;
    std::size_t other = 0;  // who: its place in `others`
    ResourceSet set = 0;    // what it owns of it, or asks for
  };
  Obstacle obstacle(const TeamMember& team, std::size_t place) const;

  // What the decider knows of an ask.
  struct Ask {
    PoolWord::Ask said;
    std::uint64_t since = 0;    // the order in which asks came
    std::uint32_t granted = 0;  // its number, until the robot has heard so
  };
  struct Robot {
    std::uint64_t run = 0;      // 0: none was heard
    std::uint64_t next = 0;     // a new one, that has not taken the place of that yet
    Nanoseconds next_since{0};  // when it was first heard
    bool follows = false, has_left = false;
    bool is_reachable = false;
    std::array<Ask, kMostAsked> asks = {};
  };
  // All that it keeps from one tick to the next, for who goes back to an earlier one.
  struct Memory {
    PoolWord own;
    std::array<bool, kMostAsked> took = {};
    std::uint32_t last_number = 0;
    std::optional<std::uint32_t> decides_in;
    std::vector<Robot> robots;
    std::uint64_t asks_heard = 0;
  };
  Memory memory() const { return {own_, took_, last_number_, decides_in_, robots_, asks_heard_}; }
  void restore(const Memory& memory);

 private:
  struct Waiting {
    std::uint64_t since;
    std::size_t robot, place;
  };

  bool decides() const { return own_.decider == declaration_.place; }
  // Its place among the others, and whether it can be heard and agrees with this one.
  std::size_t other_of(std::size_t member) const {
    return member < declaration_.place ? member : member - 1;
  }
  const TeamWord* trusted(const TeamMember& team, std::size_t other) const;
  // Its tree uses no pool of the team, so it owns nothing and decides nothing.
  static bool takes_no_part(const TeamWord& word) { return word.pool.declaration == 0; }
  ResourceSet owned_by(std::size_t robot) const;
  void find_decider(const TeamMember& team);
  bool is_next(const TeamMember& team) const;
  void follow(const TeamMember& team);
  void hear(const TeamMember& team, std::size_t member, Nanoseconds now);
  void note(Ask& ask, const PoolWord::Ask& said);
  void decide();
  void grant(std::size_t member, Ask& ask);
  void answer();

  const TeamDeclaration& declaration_;
  const std::uint64_t run_;
  PoolWord own_;
  std::array<bool, kMostAsked> asked_{}, took_{};  // in this tick; since it owns
  std::uint32_t last_number_ = 0;
  // While this one decides: of all members.
  std::optional<std::uint32_t> decides_in_;  // the term
  std::vector<Robot> robots_;
  std::vector<Waiting> waiting_;
  std::uint64_t asks_heard_ = 0;
};

}  // namespace lockstep::host
