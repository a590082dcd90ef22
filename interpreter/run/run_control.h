// Orders to a run, from another thread: pause, go on, tick so many times, run at another speed, set
// an entry, halt. The loop takes them between two ticks. Who gives them is not known here.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
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

  // Returns its number.
  std::uint64_t give(Order order);
  // What has come of it: whether it had an effect. None: the loop has not obeyed it yet.
  std::optional<bool> effect_of(std::uint64_t number) const;
  // Until the loop has obeyed more, at most so long. One thread at a time.
  void wait_for_effects(Nanoseconds longest);
  // The loop has ended, and obeys no more.
  bool has_ended() const { return has_ended_.load(std::memory_order_acquire); }

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
  // Likewise: who is told, on the thread of the loop, of an answer that nobody takes, and why.
  enum class Vain : std::uint8_t { NobodyWaits, RunEnds };
  void tell_vain_answers(std::function<void(const GivenAnswer& answer, Vain why)> tell) {
    tell_vain_ = std::move(tell);
  }

  // --- for the loop ------------------------------------------------------------------------------

  // Without new orders, one atomic load; where somebody must attend, a look at the clock. True if
  // they have changed what a checkpoint has.
  bool take_orders(Ticker& ticker, Blackboard& blackboard);
  // After that, and once it is kept: for those who wait for effects.
  void report_effects();
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
  // The run ends: it does not wait for anybody, whatever has paused it. Tells of each answer that
  // nobody takes any more.
  void end(const Ticker& ticker);
  // Returns when there are orders, after `longest`, or when a signal comes.
  void wait(Nanoseconds longest);

 private:
  enum class Effect : std::uint8_t { OnLoop, OnState, None };

  bool obey_new(Ticker& ticker, Blackboard& blackboard);
  Effect obey(const Order& order, Ticker& ticker, Blackboard& blackboard);
  void pause(bool is_stepping);
  static bool answer(const Order& order, Ticker& ticker);
  void take_answers(const Ticker& ticker);

  std::atomic<bool> has_new_{false};
  mutable Mutex mutex_;
  std::vector<Order> new_ LOCKSTEP_GUARDED_BY(mutex_);
  State state_ LOCKSTEP_GUARDED_BY(mutex_);
  std::uint64_t given_ LOCKSTEP_GUARDED_BY(mutex_) = 0;         // orders
  std::uint64_t obeyed_ LOCKSTEP_GUARDED_BY(mutex_) = 0;        // of them
  std::deque<std::uint64_t> vain_ LOCKSTEP_GUARDED_BY(mutex_);  // the last ones without an effect
  std::atomic<bool> has_ended_{false};
  std::atomic<std::uint64_t> pauses_{0};
  Bell bell_, effects_;

  // The loop's.
  std::function<void(const GivenAnswer& answer, Vain why)> tell_vain_ = [](const GivenAnswer&,
                                                                           Vain) {};
  std::uint64_t taken_ = 0, reported_ = 0;  // orders
  bool is_paused_ = false, is_halted_ = false;
  std::optional<Nanoseconds> longest_alone_ = {};  // none: nobody needs to attend
  std::optional<Nanoseconds> attended_ = {};       // when somebody did, or the run began
  bool is_attended_ = true;
  bool is_stepping_ = false;  // the pause follows from the number of ticks
  double speed_ = 0;
  std::optional<std::uint64_t> ticks_left_ = {};  // until the next pause
  Breakpoints breakpoints_;
  std::optional<Breakpoint> reached_;
  std::vector<GivenAnswer> untaken_;  // before the last tick, as of a node that is held
};

}  // namespace lockstep::host
