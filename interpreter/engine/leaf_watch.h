// Watches the calls of the leaves of one run: times them, and restores the rounding mode if a leaf
// changes it. A call begins, for the watch, where the one before it in the same tick ended: that is
// one reading of the time for each call, and the engine's own work between two calls counts for the
// second. With a TickAlarm, only some ticks are timed so: the first ones, samples of the others,
// and each tick from the call on in which the alarm rang. In a tick that took no longer than the
// budget, no call did. One thread at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/core/clock.h"
#include "base/core/histograms.h"
#include "base/system/call_mark.h"
#include "base/system/cycle_clock.h"
#include "base/system/float_mode.h"
#include "base/system/tick_alarm.h"
#include "engine/leaf_slot.h"
#include "engine/node_kind.h"

namespace lockstep::host {

struct Tree;

struct LeafWatchOptions {
  // A longer call is reported to on_slow, at most once a second for all leaves. None: calls are not
  // timed.
  std::optional<Nanoseconds> budget;
  Clock* clock = nullptr;      // that times the calls; null: a CycleClock
  TickAlarm* alarm = nullptr;  // tells of ticks that last; null: each call is timed
  // The floating-point mode is looked at after each call. Else it is once a tick, and after each
  // call while somebody who changes it is looked for.
  bool looks_after_each_call = false;
  // All on the tick thread, after the call.
  std::function<void(NodeIndex leaf, PluginFunction function, Nanoseconds took)> on_slow = {};
  // The values of the leaf's ports took that long on their way between processes: longer than the
  // budget. Not a part of what the leaf took; reported as that is.
  std::function<void(NodeIndex leaf, Nanoseconds took)> on_carried = {};
  // The leaf has changed the rounding mode or the floating-point exceptions; reported once per
  // leaf. No leaf: one of those that the last tick called, and it is not known which; reported
  // once.
  std::function<void(std::optional<NodeIndex> leaf, PluginFunction function)> on_float_mode = {};
};

class LeafWatch {
 public:
  explicit LeafWatch(LeafWatchOptions options);
  LeafWatch(const LeafWatch&) = delete;
  LeafWatch& operator=(const LeafWatch&) = delete;

  // --- for the Ticker ----------------------------------------------------------------------------

  // The mode of floating-point that leaves must keep is the one of now. Always the same tree. The
  // byte is cleared when the alarm rings.
  void begin_run(const Tree& tree, std::span<LeafSlot> leaves, ForkGuard::Byte* byte);
  void end_run();
  // Who watches may ask for progress before the tick: that is a part of it.
  void expect_tick() {
    if (options_.alarm != nullptr) open_tick();
  }
  void begin_tick();
  void end_tick();
  // The first call in line of a tick begins now, and not where the last call ended.
  void begin_calls() {
    if (!is_timed()) return;
    if (!times_each_) time_each_if_rung();
    if (times_each_) last_end_ = read();
  }

  bool is_timed() const { return options_.budget.has_value(); }
  // This, while each call is timed.
  LeafWatch* timer() { return is_timed() && times_each_ ? this : nullptr; }
  // Calls go through `begin` and `end`; else a leaf that is called in its parent's loop needs
  // `note` only, when calls are timed.
  bool looks_after_each_call() const { return looks_left_ != 0; }

  // `place`: in Tree::leaves. The call has begun where the last one ended.
  void note(std::uint32_t place, PluginFunction function, CallMark& mark) {
    const std::int64_t end = read();
    const std::int64_t took = end - std::exchange(last_end_, end);
    if (static_cast<std::uint64_t>(took) > usual_ || mark.carried != Nanoseconds(0)) [[unlikely]] {
      return note_unusual(place, function, took, std::exchange(mark.carried, Nanoseconds(0)));
    }
    if (function == PluginFunction::Tick) {
      ticks_->record_in_range(place, static_cast<std::uint64_t>(took), times_);
    }
  }
  // The same at the end of a call that was not timed: it is now, if the alarm rang in it, and so
  // are all others of this tick.
  void note_if_rung(std::uint32_t place, PluginFunction function, CallMark& mark);

  // Around any call, which may be within another one.
  struct Begun {
    std::int64_t start = 0, inner = 0;  // `inner`: calls within the one around this one, so far
    Nanoseconds carried{0};             // of the call around this one
    bool is_timed = false;
  };
  // `is_timed`: this one is, whatever others are.
  Begun begin(CallMark& mark, bool is_timed);
  void end(const Begun& begun, std::uint32_t place, PluginFunction function, CallMark& mark);

  // --- for the owner of the run ------------------------------------------------------------------

  struct Slowest {
    NodeIndex leaf = 0;
    PluginFunction function = PluginFunction::None;
    Nanoseconds took{0};
  };
  // The longest call since the tick began; its function is None when none was timed.
  Slowest slowest() const;

  // The statistics of a leaf that exceeded its budget at least once, in all runs of this watch.
  struct Timing {
    NodeIndex leaf = 0;
    bool is_sampled = false;  // until it exceeded the budget; what it ticked is estimated then
    std::uint64_t ticks = 0;  // calls of tick
    std::uint64_t over_budget = 0;  // calls of any function that took longer
    Nanoseconds p50{0}, p99{0};     // of tick, at most a sixteenth too large
    Nanoseconds max{0};             // of any function, exact
  };
  // The leaves that were over their budget, the one with the longest call first.
  std::vector<Timing> over_budget() const;

 private:
  struct OverBudget {
    std::uint64_t calls = 0;
    std::int64_t max = 0;
    bool is_sampled = false;
  };
  // The first ticks are all timed, then one of so many is, at random.
  static constexpr std::uint64_t kFirstTicks = 64;
  static constexpr std::uint32_t kSampled = 64;
  static constexpr std::uint32_t kSearched = 64;  // ticks, for a call that the alarm has missed

  // Times are counts of the processor's counter, or of the clock that was given: ns.
  std::int64_t read() const {
    return options_.clock == nullptr ? cycles_.count() : options_.clock->now().count();
  }
  Nanoseconds time_of(std::int64_t count) const {
    return options_.clock == nullptr ? cycles_.time_of(count) : Nanoseconds(count);
  }
  std::int64_t count_of(Nanoseconds time) const {
    return options_.clock == nullptr ? cycles_.count_of(time) : time.count();
  }
  NodeIndex leaf_at(std::uint32_t place) const;
  void open_tick();
  void close_tick();
  void choose_what_is_timed();
  bool is_rung() const { return options_.alarm->rang().has_value(); }
  void time_each_if_rung() {
    if (is_rung()) time_each();
  }
  void time_each();
  void note_rung(std::uint32_t place, PluginFunction function, std::int64_t inner, CallMark& mark);
  void note_unusual(std::uint32_t place, PluginFunction function, std::int64_t took,
                    Nanoseconds carried);
  void note_over_budget(std::uint32_t place, PluginFunction function, std::int64_t took);
  bool may_tell();
  void set_usual();
  void restore_mode(std::optional<NodeIndex> leaf, PluginFunction function);

  const LeafWatchOptions options_;
  const Tree* tree_ = nullptr;
  CycleClock cycles_;
  std::optional<Histograms> ticks_;  // of each leaf; when calls are timed
  std::int64_t last_end_ = 0;
  std::int64_t inner_ = 0;   // calls within the current one, of a control node's children
  std::int64_t budget_ = 0;  // as a count
  std::uint64_t usual_ = 0;  // what takes no longer is neither over the budget nor the slowest
  std::int64_t slowest_took_ = 0;
  Slowest slowest_;                   // without its time
  std::optional<std::int64_t> told_;  // when on_slow was
  std::vector<OverBudget> over_;      // of each leaf; when calls are timed
  std::span<LeafSlot> leaves_;

  bool times_each_ = true;          // calls, at this moment
  std::uint32_t times_ = 1;         // for how many ticks of a leaf one counts that is timed now
  bool is_open_ = false;            // a tick has begun, or is about to
  bool is_timed_whole_ = true;      // this tick, from its first call on
  bool is_explained_ = false;       // that it took long: by a call over the budget
  Nanoseconds opened_at_{0};        // on the clock of the alarm
  std::int64_t opened_ = 0;         // the same, as a count
  std::uint64_t first_serial_ = 0;  // of the mark, before the first call
  std::uint64_t opened_ticks_ = 0, random_ = 0x9E3779B97F4A7C15;
  std::uint32_t searches_left_ = 0;  // ticks that are timed to find who takes long

  FloatMode mode_;
  std::uint32_t looks_left_ = 0;  // ticks with a look after each call, with this one
  std::uint32_t next_looks_ = 1;  // as many, when a tick without has found a change
  bool unknown_told_ = false;
  std::vector<NodeIndex> mode_told_;
};

}  // namespace lockstep::host
