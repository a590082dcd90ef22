// Orders to a run, from another thread: pause, go on, tick so many times, run at another speed, set
// an entry, halt. The loop takes them between two ticks. Who gives them is not known here.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/blackboard/entry.h"
#include "base/core/value.h"
#include "base/system/bell.h"
#include "base/system/mutex.h"
#include "engine/ticker.h"
#include "run/breakpoints.h"

namespace lockstep::host {

class RunControl {
 public:
  struct Order {
    enum class What : std::uint8_t { Pause, Resume, Step, Halt, Speed, Set, Break, Answer, Attend };
    What what;
    std::uint64_t ticks = 0;  // Step
    double speed = 0;         // of the virtual clock; 0: as fast as possible
    std::uint32_t slot = 0;   // Set: of the blackboard
    ValueType type = ValueType::String;
    Value value = {};                        // of that type
    Breakpoint breakpoint = {};              // Break
    bool is_on = true;                       // else it is removed
    NodeIndex node = 0;                      // Answer: who asks
    std::uint32_t option = 0;                // its place among those of the node
    std::optional<std::uint64_t> seen = {};  // the last tick that the person saw
    std::string text = {}, who = {};         // the option, and the person
  };

  // --- for any thread ----------------------------------------------------------------------------

  void give(Order order);

  struct State {
    bool is_paused = false;
    double speed = 0;
    std::optional<Breakpoint> breakpoint = {};  // that paused it
    // Where somebody must attend: whether somebody does. If not, it stands.
    std::optional<bool> is_attended = {};

    friend bool operator==(const State&, const State&) = default;
  };
  State state() const;
  // How often the run has come to stand.
  std::uint64_t pauses() const { return pauses_.load(std::memory_order_acquire); }

  // Before the run: it stands while nobody has attended for so long, by the wall clock.
  void need_attendance(Nanoseconds longest);

  // --- for the loop ------------------------------------------------------------------------------

  // Without new orders, one atomic load; where somebody must attend, a look at the clock.
  void take_orders(Ticker& ticker, Blackboard& blackboard);
  // True while the next tick must not come yet.
  bool is_paused() const { return is_paused_ || !is_attended_; }
  bool is_attended() const { return is_attended_; }
  bool is_told_to_pause() const { return is_paused_; }
  // Not after the last of some ticks that were ordered: those end with their periods.
  bool pauses_at_once() const { return (is_paused_ && !is_stepping_) || !is_attended_; }
  bool pauses_after_tick() const { return ticks_left_ == 1; }  // the next one
  bool is_halted() const { return is_halted_; }
  // The breakpoint that the last tick has come to.
  const std::optional<Breakpoint>& reached() const { return reached_; }
  double speed() const { return speed_; }
  // After each tick.
  void count_tick(Ticker& ticker);
  // The run stands, or goes on: for state(). Until then a pause is only on its way.
  void report_standing(bool stands);
  // The run ends: it does not wait for anybody, whatever has paused it.
  void end() { is_paused_ = false, is_attended_ = true; }
  // Returns when there are orders, after `longest`, or when a signal comes.
  void wait(Nanoseconds longest);

 private:
  void obey_new(Ticker& ticker, Blackboard& blackboard);
  void obey(const Order& order, Ticker& ticker, Blackboard& blackboard);
  void pause(bool is_stepping);
  static void set(Entry& entry, const Order& order);
  static void answer(const Order& order, Ticker& ticker);

  std::atomic<bool> has_new_{false};
  mutable Mutex mutex_;
  std::vector<Order> new_ LOCKSTEP_GUARDED_BY(mutex_);
  State state_ LOCKSTEP_GUARDED_BY(mutex_);
  std::atomic<std::uint64_t> pauses_{0};
  Bell bell_;

  // The loop's.
  bool is_paused_ = false, is_halted_ = false;
  std::optional<Nanoseconds> longest_alone_ = {};  // none: nobody needs to attend
  std::optional<Nanoseconds> attended_ = {};       // when somebody did, or the run began
  bool is_attended_ = true;
  bool is_stepping_ = false;  // the pause follows from the number of ticks
  double speed_ = 0;
  std::optional<std::uint64_t> ticks_left_ = {};  // until the next pause
  Breakpoints breakpoints_;
  std::optional<Breakpoint> reached_;
};

}  // namespace lockstep::host
