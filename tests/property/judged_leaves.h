// Of the judge of verify: what leaves may do, by docs/verify.md alone, and one answer after the
// other.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "property/kept_state.h"
#include "property/leaf_behavior.h"

namespace lockstep::host::test {

// Something about the world that conditions ask for, and how it changes by itself.
struct FactRule {
  enum class Changes : std::uint8_t { Freely, Never, Rises, Falls };
  Changes changes;
};

// What one leaf may do.
struct LeafRule {
  std::string name;
  bool is_action = true;
  bool succeeds = true, fails = true, skips = false;
  int least_ticks = 1, most_ticks = 0;  // 0: without end
  int parts = 0;                        // of its progress; 0: it has none
  int least_step = 0, most_step = 0;    // in parts
  bool finishes_full = false;
  int least_drift = 0, most_drift = 0;
  int fact = -1;         // a condition: its result
  int sets = -1;         // an action: its success makes that fact …
  bool sets_to = false;  // … true or false
  enum class Writes : std::uint8_t { WithSuccess, AtStart, InEachTick, InAnyTick };
  std::string entry = {};  // that its output writes; "": none
  Writes writes = Writes::InAnyTick;
  std::vector<AfterCut> after_cut = {};  // that it may do; empty: it begins again

  // Of a leaf file.
  std::string row() const;
};

class JudgedLeaves final : public LeafBehavior {
 public:
  JudgedLeaves(std::vector<LeafRule> rules, const std::vector<FactRule>& facts);

  void start(std::uint32_t leaf) override;
  Status tick(std::uint32_t leaf) override;
  void halt(std::uint32_t leaf) override;
  void pause(std::uint32_t leaf) override;
  void resume(std::uint32_t leaf) override;
  double progress(std::uint32_t leaf) const override;
  AfterCut cut(std::uint32_t leaf, bool has_ticked) override;

  // Gives an entry a value.
  using Write = std::function<void(const std::string& entry, double value)>;
  void set_write(Write write) { write_ = std::move(write); }

  void keep(KeptState& state);
  // The first answers of a tick, then all others: false when they have all been given.
  void first_answers();
  bool next_answers();
  // Before each tick of the tree, and before a cut.
  void begin_tick();
  // Then what is held may drift.
  void drift();

  // In the tick: a bit for each action that got a tick, and for each activation that has ended.
  std::uint32_t worked() const { return worked_; }
  std::uint32_t ended() const { return ended_; }
  // "a0=R0.5 a1=S"
  const std::string& said() const { return said_; }
  // A call that the contract of leaves forbids, or "".
  const std::string& broken() const { return broken_; }

 private:
  enum class Phase : std::uint8_t { Idle, Running, Held };
  struct Leaf {
    Phase phase = Phase::Idle;
    int ticks = 0, level = 0;
  };
  // Its value is unknown until a leaf asks for it.
  struct Fact {
    FactRule::Changes changes;
    std::optional<bool> value = {};
    bool was_asked = false;  // in this tick
  };
  std::uint32_t choose(std::uint32_t count);
  bool ask(Fact& fact);
  void write(std::uint32_t leaf, bool may_leave_it);
  Status result(std::uint32_t leaf);
  void needs(bool holds, std::uint32_t leaf, const char* call);
  void say(std::uint32_t leaf, const std::string& word);
  Status end(std::uint32_t leaf, Status result);
  void move(std::uint32_t leaf, int least, int most, int highest);

  const std::vector<LeafRule> rules_;
  Write write_;
  std::vector<Leaf> leaves_;
  std::vector<Fact> facts_;
  std::vector<std::uint32_t> answers_, counts_;
  std::size_t at_ = 0;
  std::uint32_t worked_ = 0, ended_ = 0;
  std::string said_, broken_;
};

}  // namespace lockstep::host::test
