// One run of a tree: the ticker, the blackboard and the leaves, in the order of their lives.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "base/core/tick_budget.h"
#include "engine/blackboard.h"
#include "engine/leaf_watch.h"
#include "engine/ticker.h"
#include "leaves/plugin/contract/boards.h"
#include "leaves/plugin/contract/leaf_set.h"
#include "leaves/plugin/contract/process_leaves.h"
#include "leaves/plugin/contract/wake_up.h"
#include "leaves/plugin/contract/workers.h"

namespace lockstep::host {

struct RunOptions {
  std::uint64_t seed = 0;
  double rate = 100;  // ticks per second: a time that is counted has whole periods of it
  LeafLog log = {};
  FaultPolicy on_fault = FaultPolicy::Stop;
  bool exactly_once = false;   // ticks the root once, also when a node asks for another tick
  bool virtual_time = false;   // time jumps, so ticks wait for the threads of leaves
  LeafWatch* watch = nullptr;  // must outlive the run; null: nothing is watched and nothing costs
  // Gives entries their first values, before leaves are made; of a run with boards.
  std::function<void(BoardsOfRun& boards)> prepare = {};
  EndBudget* end_budget = nullptr;     // the same; null: each that waits has its own patience
  bool may_wake = false;               // its owner calls wake(); else only leaves may
  std::function<void()> on_wake = {};  // a leaf wants a tick at once; from any thread
};

class Run {
 public:
  static constexpr int kMostTicksAtOnce = 10'000;

  // `tree` must outlive the run. Several runs may share one tree, each on a separate thread.
  Run(const Tree& tree, const RunOptions& options);
  // Halts the running leaves, then destroys all leaves.
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  // Ends the run as the destructor does and begins another one, as a new Run with this seed would,
  // with the memory of this one.
  void restart(std::uint64_t seed);

  // The time of the next tick, counted from the start of the run; for observers that look at the
  // run just before it.
  void set_now(Nanoseconds now);
  // One tick of the root at `now`; see Ticker::tick_root. While it is Running and a node asks for
  // another tick, it gets one at once, at most kMostTicksAtOnce.
  Status tick(Nanoseconds now) {
    set_now(now);
    return tick(exactly_once_);
  }
  // The same at the time that set_now has set. Workers get their turns again: one may wait for a
  // time that has passed.
  Status tick() {
    give_turns();
    return tick(exactly_once_);
  }
  // The same without that other tick.
  Status tick_exactly_once(Nanoseconds now) {
    set_now(now);
    return tick(true);
  }
  // Whether the processes of held leaves are still there, as before each tick: for an owner that
  // lets no tick come.
  void look_at_processes() {
    if (!processes_.empty()) processes_.look(ticker_);
  }
  // Halts every running leaf, in order.
  void halt();
  // After a fault: halts, and the next tick begins the tree. False: a leaf could not be created.
  bool recover();
  // The waiting for the next tick of this run, which a leaf may end; null if none may.
  WakeUp* wake_up() { return may_wake_ ? &wake_up_ : nullptr; }
  // From any thread: as if a leaf wanted a tick.
  void wake() { wake_up_.wake(); }

  // Null while every leaf has kept its contract.
  const Fault* fault() const;
  Ticker& ticker() { return ticker_; }
  // For the owner, between ticks.
  Blackboard& blackboard() { return blackboard_; }
  BoardsOfRun* boards() { return boards_.get(); }  // null: see make_boards
  Nanoseconds period() const { return time_.period; }
  LeafWatch* watch() const { return watch_; }  // null: not watched
  EndBudget* end_budget() const { return time_.end_budget; }

 private:
  void adopt_thread();
  void give_turns() {
    ++time_.turns;
    workers_.give_turns(time_.now);
  }
  Status tick(bool exactly_once);
  Status tick_again_if_asked(Status status, bool exactly_once);

  void prepare();

  Blackboard blackboard_;
  OwnBoards boards_;
  const std::function<void(BoardsOfRun& boards)> prepare_;
  Workers workers_;
  ProcessLeaves processes_;
  WakeUp wake_up_;
  TickBudget budget_;
  const bool may_wake_;
  const bool exactly_once_;
  LeafTime time_;
  LeafWatch* watch_;
  LeafSet leaves_;
  Ticker ticker_;
};

}  // namespace lockstep::host
