// A robot as a member of a team: which round of it the robot does, and what it knows of the others.
// This is the law of docs/team.md, without a network, a clock and a tree: whoever owns it gives it
// what is heard, and what its own tree does. One thread at a time; nothing allocates after the
// constructor.
//
// A round is what the team does once in step. It is completed by each member for itself, and
// counted, so that what was heard of an earlier one opens nothing:
//
//   A member that begins its InStep does the round behind the last one that it has completed. A new
//   process has completed none: once it has heard all others, it does the earliest of their rounds.
//   A failure or a halt ends no round: the member does the same one again, from 0.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/core/clock.h"
#include "team/word.h"

namespace lockstep::host {

// What a team is in the tree of one of its members.
struct TeamDeclaration {
  std::string team, self;
  std::vector<std::string> others;
  std::uint64_t hash = 0;
  Nanoseconds deadline{0};  // at least kFewestPeriods of the slowest member; 0: kPeriodsOfSilence
  Nanoseconds period{0};    // of the own ticks
  // The pool that the team shares, if the tree has it.
  std::vector<std::string> resources = {};
  std::uint64_t pool_hash = 0;  // 0: none
  std::size_t place = 0;        // of this robot among all members; the others are in their order
};

inline constexpr int kPeriodsOfSilence = 5, kFewestPeriods = 2;

class TeamMember {
 public:
  TeamMember(TeamDeclaration declaration, std::uint64_t run);

  const TeamDeclaration& declaration() const { return declaration_; }

  // What is known of another member now. Those that are in this round have a progress, also while
  // they are silent: the last one that was heard. Those that have completed it have 1.
  enum class Where : std::uint8_t {
    InRound,
    NotBegun,   // heard, and not in this round
    Passed,     // it has completed this round
    Unheard,    // since this process began
    Silent,     // not since the deadline
    Nonsense,   // nor anything that makes sense
    Contested,  // two robots have its name, or it contradicts itself
    Stranger,   // its tree declares the team in another way
  };
  struct Known {
    Where where = Where::Unheard;
    double progress = 0;
    Nanoseconds age{0};                 // since it was heard last; of one that was
    std::uint64_t run = 0, number = 0;  // of that word; number 0: none was
  };
  static bool is_known(Where where) { return where <= Where::Passed; }

  // What another one, by its place in `others`, has said, which was received at `at`. Those that
  // are older than what is known of the run change nothing.
  void hear(std::size_t other, const TeamWord& word, Nanoseconds at);
  // A word of the own name, which may be that of another robot.
  void hear_own_name(const TeamWord& word, Nanoseconds at);

  // At the beginning of each tick, with its time on the same clock. Then `known` is of this tick.
  void look(Nanoseconds now);
  const Known& known(std::size_t other) const { return others_[other].known; }
  // What it has said last; null: nothing yet.
  const TeamWord* heard(std::size_t other) const {
    const auto& last = others_[other].last;
    return last ? &last->word : nullptr;
  }
  bool is_silent(std::size_t other) const { return others_[other].known.age > deadline_; }
  // Two robots have its name, or it contradicts itself.
  bool is_contested(std::size_t other) const;
  Nanoseconds deadline() const { return deadline_; }
  std::uint64_t run() const { return own_.run; }
  // Another robot has the own name.
  bool is_contested() const { return is_contested_; }

  // After a tick: whether the own InStep runs, with its child's progress, and how it has ended in
  // this tick, if it has.
  enum class End : std::uint8_t { None, Success, Other };
  void set_own(bool is_in, double progress, End end);
  // What to say, with that of the pool.
  TeamWord word(const PoolWord& pool = {});

  bool is_in() const { return own_.is_in; }  // as it was said last
  std::uint32_t round() const { return own_.round; }
  std::uint32_t passed() const { return own_.passed; }
  // Before the first tick of a process that continues a run after a cut: where that was.
  void resume(std::uint32_t round, std::uint32_t passed) {
    own_.round = round;
    own_.passed = passed;
  }

  // All that it keeps from one tick to the next, for who goes back to an earlier one.
  struct Run {
    TeamWord word;
    Nanoseconds at{0};
  };
  struct Other {
    std::optional<Run> last, before;       // the run that was heard last, and the one before it
    std::optional<Nanoseconds> contested;  // when two were last heard
    std::optional<Nanoseconds> nonsense;   // when it was last heard
    Known known;
  };
  struct Memory {
    TeamWord own;
    std::vector<Other> others;
    std::optional<Nanoseconds> own_name_heard;
  };
  Memory memory() const { return {own_, others_, own_name_heard_}; }
  void restore(const Memory& memory);

 private:
  Where where_of(const Other& other, Nanoseconds now) const;
  bool is_contested(const Other& other, Nanoseconds now) const;
  bool is_in_round(const TeamWord& word) const;
  void join();
  void follow();

  const TeamDeclaration declaration_;
  TeamWord own_;
  std::vector<Other> others_;
  Nanoseconds deadline_{0};
  Nanoseconds now_{0};  // of the last look
  std::optional<Nanoseconds> own_name_heard_;
  bool is_contested_ = false;
};

}  // namespace lockstep::host
