// Leaves that do what their models allow, as answers choose. All that they keep is a few bytes for
// each, which a search saves and compares. They refuse an order of calls that the contract forbids.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/blackboard.h"
#include "engine/cut.h"
#include "engine/leaf_slot.h"
#include "leaves/answers.h"
#include "leaves/models.h"

namespace lockstep::host {

// Cut: it ran when its process was cut, and has not got a tick since; `level` is what it does then.
enum class Phase : std::uint8_t { Idle, Running, Paused, Cut };

// The state of a leaf between two ticks; all 0 while it is idle.
struct LeafState {
  std::uint32_t ticks = 0;  // of this activation, as far as their number matters
  std::uint16_t level = 0;
  Phase phase = Phase::Idle;

  static LeafState cut(AfterCut does) {
    return {.level = static_cast<std::uint16_t>(does), .phase = Phase::Cut};
  }
  AfterCut after_cut() const { return static_cast<AfterCut>(level); }
  bool runs() const { return phase == Phase::Running || phase == Phase::Paused; }
  bool notices_cut() const { return phase != Phase::Idle; }

  friend bool operator==(const LeafState&, const LeafState&) = default;
};

enum class FactState : std::uint8_t { False, True, Unknown };
// Before the first tick.
std::vector<FactState> first_facts(const LeafModels& models);

// To which levels a leaf may come, and whether it may succeed, or has to.
struct LevelReach {
  std::int32_t first, last;
  bool may_succeed, must_succeed;
};
// From each level of the model: in a tick, and in one that is withheld.
std::vector<LevelReach> reaches_in_a_tick(const LeafModel& model);
std::vector<LevelReach> reaches_while_held(const LeafModel& model);

inline constexpr std::uint32_t kNoWrite = 0xffffffff;

// A mark says what a leaf did in a tick of the tree.
struct LeafMark {
  bool touched = false;  // it has a mark at all
  bool ticked = false, ended = false;
  bool is_open = false;  // it may wait: asked in this tick already, or not since its start or a cut
  bool faulted = false;
  bool drifted = false;                     // it was held before it, and may drift
  Status result = Status::Idle;             // of its tick
  double progress = 0;                      // after it
  double held_progress = 0;                 // before it, if it has drifted
  std::vector<std::uint32_t> written = {};  // of each output, in order: which value, or kNoWrite

  void clear() {
    ticked = ended = faulted = drifted = false;
    result = Status::Idle;
    if (!written.empty()) written.clear();
  }
};

// Does what some leaves do, in place of their models: those that stand for other robots.
class OutsideLeaves {
 public:
  virtual bool has(std::uint32_t leaf) const = 0;
  virtual void start(std::uint32_t leaf) = 0;
  virtual Status tick(std::uint32_t leaf) = 0;
  virtual double progress(std::uint32_t leaf) const = 0;

 protected:
  ~OutsideLeaves() = default;
};

// The leaves of a run.
class ModelLeaves {
 public:
  // The entry to which an output belongs; null: none.
  using EntryOf = std::function<Entry*(std::uint32_t leaf, const LeafModel::Output& output)>;
  // All must outlive this.
  ModelLeaves(const Tree& tree, const LeafModels& models, Blackboard& board, Answers& answers);
  ModelLeaves(const Tree& tree, const LeafModels& models, EntryOf entry_of, Answers& answers);
  ModelLeaves(const ModelLeaves&) = delete;
  ModelLeaves& operator=(const ModelLeaves&) = delete;

  // Before the first tick. It must outlive this.
  void set_outside(OutsideLeaves& outside);
  bool is_outside(std::uint32_t leaf) const { return outside_ != nullptr && outside_->has(leaf); }

  // The engine calls these for a leaf, by its number.
  void start(std::uint32_t leaf);
  Status tick(std::uint32_t leaf);
  void halt(std::uint32_t leaf);
  void pause(std::uint32_t leaf);
  void resume(std::uint32_t leaf);
  double progress(std::uint32_t leaf) const { return progress_[leaf]; }

  std::span<LeafSlot> slots() { return slots_; }
  const std::vector<LeafState>& states() const { return states_; }
  const std::vector<FactState>& facts() const { return facts_; }
  // Whether the next tick of a leaf in this state, which runs, may be its last one, with Success.
  bool may_succeed(std::uint32_t leaf, const LeafState& state) const;
  void restore(const std::vector<LeafState>& states, const std::vector<FactState>& facts);
  // The same after the first time: back to what was restored last, from one tick behind it.
  void restore_again(const std::vector<LeafState>& states, const std::vector<FactState>& facts);

  // Before each tick of the tree; then `cut`, if its process was cut since the last one, and
  // `drift`.
  void begin_tick();
  // Of a leaf that ran.
  void cut(const CutLeaf& leaf);
  // What is held may go on.
  void drift();
  // Within it: from here on, marks say only what is done from here on.
  void clear_marks();
  // Called before a leaf is ticked that has been ticked already; then its marks begin anew.
  using BeforeTickAgain = std::function<void(std::uint32_t leaf)>;
  void set_before_tick_again(BeforeTickAgain call) { before_tick_again_ = std::move(call); }
  // After it: what does not matter any more is 0, if it was so before the tick.
  void fold();
  std::span<const LeafMark> marks() const { return marks_; }
  // The leaves that have marks, each once.
  std::span<const std::uint32_t> touched() const { return touched_; }
  // Visits what a fold forgets that counts within the tick.
  template <class Visit>
  void for_each_of_tick(Visit visit) const {
    for_each_fact(visit);
    for (const std::uint32_t leaf : touched_) {
      visit(leaf);
      visit(marks_[leaf].ticked);
      visit(marks_[leaf].ended);
      visit(marks_[leaf].is_open);
    }
  }
  // The facts, and which of them were asked for in this tick.
  template <class Visit>
  void for_each_fact(Visit visit) const {
    for (const FactState it : facts_) visit(it);
    for (const bool it : asked_) visit(it);
  }
  // The leaf whose call asks for an answer.
  static constexpr std::uint32_t kNobody = 0xffffffff;  // what drifts does so before the tick
  std::uint32_t chooses() const { return chooses_; }
  // How far that call is: which of its questions it asks.
  std::uint32_t stage() const { return stage_; }
  // The call of the engine that the contract forbids; "" for none.
  const std::string& broken() const { return broken_; }

 private:
  struct Self {
    ModelLeaves* all;
    std::uint32_t number;
  };
  struct Functions;
  friend struct Functions;

  LeafMark& mark(std::uint32_t leaf) {
    LeafMark& mark = marks_[leaf];
    if (!mark.touched) {
      mark.touched = true;
      touched_.push_back(leaf);
    }
    return mark;
  }
  void restore_progress(std::uint32_t leaf);
  bool is(std::uint32_t leaf, bool expected, const char* what) {
    if (!expected) [[unlikely]]
      tell_broken(leaf, what);
    return expected;
  }
  void tell_broken(std::uint32_t leaf, const char* what);
  bool ask(std::uint32_t fact);
  Status tick_as_chosen(std::uint32_t leaf);
  Status wait_for_answer(std::uint32_t leaf);
  Status tick_outside(std::uint32_t leaf);
  void write(std::uint32_t leaf);
  // Each output, or not.
  void may_write(std::uint32_t leaf, bool has_succeeded = false);
  void write(std::uint32_t leaf, const LeafModel::Output& output, std::uint32_t value);
  std::uint32_t choose_end(std::uint32_t leaf, std::uint32_t running);
  void set_facts(std::uint32_t leaf, Status result);
  void set_level(std::uint32_t leaf, std::int32_t level) {
    states_[leaf].level = static_cast<std::uint16_t>(level);
    progress_[leaf] = rules_[leaf].levels[level];
  }

  // All that most ticks read of a model.
  struct Rule {
    explicit Rule(const LeafModel& model);
    void be_late(const LeafModel& model);

    const double* levels;
    std::uint32_t least_ticks, most_ticks;
    std::uint32_t enough_ticks = 0;                 // more of them are the same
    std::vector<LevelReach> in_a_tick, while_held;  // from each level
    bool can_run;
    bool is_plain;                   // it has to do with no fact and no entry
    bool may_write, may_write_idle;  // in each tick, or not; and when it gets none
    bool may_wait;                   // for an answer that counts later, which shows
    ResultSet results;
    std::vector<double> chances;  // of the results that it may have, in their order
  };

  const Tree& tree_;
  const LeafModels& models_;
  const EntryOf entry_of_;
  Answers& answers_;
  std::vector<Rule> rules_;
  std::vector<Self> selves_;
  std::vector<LeafSlot> slots_;
  std::vector<LeafState> states_;
  std::vector<FactState> facts_;
  std::vector<bool> asked_;       // of each fact, in this tick
  std::vector<double> progress_;  // of each leaf
  std::vector<LeafMark> marks_;
  std::vector<std::uint32_t> touched_;
  std::vector<std::uint32_t> drifting_;  // the leaves that may
  std::uint32_t chooses_ = kNobody;
  std::uint32_t stage_ = 0;
  std::string broken_;
  BeforeTickAgain before_tick_again_;
  OutsideLeaves* outside_ = nullptr;  // null: all are as their models
};

}  // namespace lockstep::host
