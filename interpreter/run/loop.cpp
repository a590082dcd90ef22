#include "run/loop.h"

#include <signal.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/core/deadlines.h"
#include "base/system/own_thread.h"
#include "run/checkpoint/checkpoint_writer.h"
#include "run/observers.h"
#include "run/pace.h"
#include "run/run_control.h"
#include "run/stall_fail.h"
#include "run/watched_leaves.h"

namespace lockstep::host {
namespace {

// A stop signal that comes between the look at it and the sleep does not end the sleep.
constexpr Nanoseconds kLongestSleep = std::chrono::milliseconds(100);

class Loop {
 public:
  Loop(Run& run, Clock& clock, const LoopOptions& options, std::span<Observer* const> observers)
      : run_(run),
        clock_(clock),
        options_(options),
        observers_(run.ticker().tree(), observers),
        deadlines_(options.rate),
        is_real_(clock.is_real()),
        first_(options.before.ticks == 0
                   ? 0
                   : deadlines_.first_from(options.before.time + Nanoseconds(1))),
        begun_(clock.now() - deadlines_.at(first_)),
        start_(begun_),
        wake_up_(is_real_ ? run.wake_up() : nullptr),
        deadline_(first_) {
    end_.ticks = end_.first_tick = options.before.ticks;
    end_.last = options.before.time;
  }

  RunEnd run() {
    observe([&](Observers& it) {
      it.run_started(run_.ticker(), {run_.period(), is_real_, end_.first_tick, options_.before.gap,
                                     options_.before.set});
    });
    watch_leaves([&](WatchedLeaves& it) { it.begin(run_.ticker()); });
    if (run_.fault() == nullptr) {  // of a leaf that could not be created
      while (may_tick() && (options_.control == nullptr || is_admitted()) && tick() &&
             meet_next()) {
        wait();
      }
    }
    // On the virtual clock the last tick, too, lasts until the next one would begin.
    end_.time =
        is_real_ ? clock_.now() - start_ : deadlines_.at(first_ + end_.ticks - end_.first_tick);
    if (options_.control != nullptr) options_.control->end(run_.ticker());
    observe([&](Observers& it) { it.standing(run_.ticker()); });
    run_.halt();
    end_.budget = run_.end_budget();
    if (end_.budget != nullptr) end_.budget->begin();
    if (run_.fault() != nullptr) {
      end_.reason = StopReason::Fault;
      end_.fault = *run_.fault();
    }
    observe([&](Observers& it) { it.run_ended(run_.ticker(), end_); });
    return end_;
  }

 private:
  // Observers read entries.
  template <class Tell>
  void observe(Tell tell) {
    const InEngine scope(run_.blackboard().lock.get());
    tell(observers_);
  }

  // They are compared with what entries have.
  template <class Call>
  void watch_leaves(Call call) {
    if (options_.watched_leaves == nullptr) return;
    const InEngine scope(run_.blackboard().lock.get());
    call(*options_.watched_leaves);
  }

  bool may_tick() {
    rethrow_thread_failure();
    if (stop_requested()) return stop(is_stopped_ ? StopReason::Stopped : StopReason::Signal);
    if (options_.writing_failed && options_.writing_failed()) {
      return stop(StopReason::Recording);
    }
    if (options_.property_violated && options_.property_violated()) {
      return stop(StopReason::Property);
    }
    if (options_.max_ticks && end_.ticks >= *options_.max_ticks) return stop(StopReason::MaxTicks);
    if (clock_.now() - begun_ >= std::min(options_.timeout.value_or(kLongestRun), kLongestRun)) {
      return stop(StopReason::Timeout);
    }
    if (options_.control != nullptr && options_.control->is_halted()) {
      end_.signal = SIGINT;  // as Ctrl-C
      return stop(StopReason::Signal);
    }
    return true;
  }

  // Before each tick: what others order, and the time until they let it come. False: it does not.
  bool is_admitted() {
    take_orders();
    if (!may_tick()) return false;
    if (options_.control->is_paused() && !stand()) return false;
    return is_real_ || keep_pace();
  }

  void take_orders(bool stands = false) {
    const InEngine scope(run_.blackboard().lock.get());
    const bool has_changed = options_.control->take_orders(run_.ticker(), run_.blackboard());
    if (has_changed && options_.checkpoints != nullptr) {
      options_.checkpoints->between_ticks(run_.ticker(), stands);
    }
    options_.control->report_effects();
  }

  // The run's time stands still until it goes on, at the time of the next tick. So the leaves
  // and the nodes that count time lose nothing, and no deadline is missed.
  bool stand() {
    const Nanoseconds time = deadlines_.at(deadline_);
    observe([&](Observers& it) { it.standing(run_.ticker()); });
    if (is_real_) {  // there, leaves go on by themselves
      run_.set_now(time);
      run_.ticker().pause(0);
    }
    options_.control->report_standing(true);
    bool goes_on = may_tick() && !run_.ticker().faulted();
    while (goes_on && options_.control->is_paused()) {
      options_.control->wait(kLongestSleep);
      take_orders(true);
      if (is_real_) run_.look_at_processes();
      goes_on = may_tick() && !run_.ticker().faulted();
    }
    options_.control->report_standing(false);
    if (is_real_) start_ = clock_.now() - time;
    pace_.restart();
    return goes_on;
  }

  // Waits where the virtual clock is not to run as fast as it can.
  bool keep_pace() {
    pace_.set(run_.period(), options_.control->speed());
    while (pace_.is_early()) {
      options_.control->wait(std::min(pace_.left(), kLongestSleep));
      take_orders();
      if (!may_tick()) return false;
      if (options_.control->is_paused()) return is_admitted();
      pace_.set(run_.period(), options_.control->speed());
    }
    pace_.count();
    return true;
  }

  // It is not called again after its first nonzero answer: one that takes an event gives it once.
  bool stop_requested() {
    if (end_.signal == 0 && options_.stop_signal) end_.signal = options_.stop_signal();
    is_stopped_ = is_stopped_ || (options_.stopped && options_.stopped());
    return end_.signal != 0 || is_stopped_;
  }

  bool stop(StopReason reason) {
    end_.reason = reason;
    return false;
  }

  // True while the run goes on.
  bool tick() {
    const Nanoseconds now = clock_.now() - start_;
    const bool is_due = is_real_ && !is_woken_;
    const Nanoseconds late = is_due ? now - deadlines_.at(deadline_) : Nanoseconds(0);
    if (wake_up_ != nullptr) wakes_ = wake_up_->wakes();
    Ticker& ticker = run_.ticker();
    if (cuts_ < options_.cuts.size() && options_.cuts[cuts_].tick == end_.ticks) cut(ticker);
    run_.set_now(now);
    observe([&](Observers& it) { it.before_tick(ticker, end_.ticks, now); });
    if (options_.stall_fail != nullptr) options_.stall_fail->before_tick(ticker, now);
    watch_leaves([&](WatchedLeaves& it) { it.before_tick(ticker); });
    if (options_.checkpoints != nullptr) ticker.set_durable(options_.checkpoints->durable());
    end_.status = run_.tick();
    if (options_.stall_fail != nullptr) options_.stall_fail->after_tick(ticker, now);
    watch_leaves([&](WatchedLeaves& it) { it.after_tick(ticker, end_.ticks, now); });
    if (is_real_) note_worst(clock_.now() - start_ - now);
    // The loop keeps its own copy: an observer that asks for progress may add to the ticker's.
    std::vector<Fault> faults;
    if (!ticker.tolerated().empty()) [[unlikely]]
      faults = ticker.take_tolerated();
    const TickReport report{end_.ticks, now, end_.status, skipped_before_, faults, late};
    observe([&](Observers& it) { it.after_tick(ticker, report); });
    if (options_.control != nullptr) options_.control->count_tick(ticker);
    ++end_.ticks;
    end_.last = now;
    if (ticker.faulted()) return false;
    if (has_ended(end_.status)) return stop(StopReason::Completed);
    if (options_.checkpoints != nullptr) keep();
    return true;
  }

  void cut(Ticker& ticker) {
    const ScriptCut& how = options_.cuts[cuts_++];
    std::vector<CutLeaf> leaves = ticker.cut_leaves();
    const Tree& tree = ticker.tree();
    for (CutLeaf& it : leaves) it.does = how.of(tree.path(tree.leaves[it.place].node));
    ticker.go_on_after_cut(leaves);
    watch_leaves([&](WatchedLeaves& it) { it.begin(ticker); });
    if (options_.cut) options_.cut(leaves);
  }

  void keep() {
    const InEngine scope(run_.blackboard().lock.get());
    options_.checkpoints->after_tick(run_.ticker(), end_.ticks);
  }

  void note_worst(Nanoseconds took) {
    if (took <= end_.worst.took) return;
    end_.worst = WorstTick();
    end_.worst.tick = end_.ticks;
    end_.worst.took = took;
    if (run_.watch() == nullptr) return;
    const LeafWatch::Slowest slowest = run_.watch()->slowest();
    if (slowest.took * 2 < took) return;
    end_.worst.leaf = slowest.leaf;
    end_.worst.leaf_took = slowest.took;
  }

  // Chooses the deadline that the next tick waits for. False: the run ends because it has passed.
  bool meet_next() {
    if (!std::exchange(is_woken_, false)) ++deadline_;
    skipped_before_ = 0;
    if (!is_real_) return true;
    const Nanoseconds now = clock_.now() - start_;
    if (now <= deadlines_.at(deadline_)) return true;
    ++end_.overruns;
    if (options_.overrun == OverrunPolicy::Fail) return stop(StopReason::Overrun);
    if (options_.overrun == OverrunPolicy::CatchUp) return true;
    const std::uint64_t next = deadlines_.first_from(now);
    end_.skipped += skipped_before_ = next - deadline_;
    deadline_ = next;
    return true;
  }

  // Any signal ends a sleep, only a stop signal ends the wait.
  void wait() {
    const Nanoseconds deadline = start_ + deadlines_.at(deadline_);
    if (!is_real_) return clock_.sleep_until(deadline);
    const Nanoseconds awake = deadline - options_.spin;
    for (auto now = clock_.now(); now < awake; now = clock_.now()) {
      if (is_wait_over()) return;
      const Nanoseconds end = std::min(awake, now + kLongestSleep);
      wake_up_ == nullptr ? clock_.sleep_until(end) : wake_up_->wait(wakes_, end - now);
    }
    while (clock_.now() < deadline && !stop_requested() && !is_woken()) {
    }
  }

  // A leaf wants a tick before the deadline, which is met all the same.
  bool is_woken() {
    is_woken_ = is_woken_ || (wake_up_ != nullptr && wake_up_->wakes() != wakes_);
    return is_woken_;
  }

  // Before the deadline.
  bool is_wait_over() {
    if (stop_requested() || is_woken()) return true;
    if (options_.control == nullptr) return false;
    take_orders();
    return options_.control->pauses_at_once() || options_.control->is_halted();
  }

  Run& run_;
  Clock& clock_;
  const LoopOptions& options_;
  Observers observers_;
  const Deadlines deadlines_;
  const bool is_real_;
  const std::uint64_t first_;  // number of the first deadline
  const Nanoseconds begun_;
  Nanoseconds start_;        // as if there had been no pauses
  WakeUp* const wake_up_;    // null: nobody ends a wait
  std::uint32_t wakes_ = 0;  // before the last tick
  bool is_stopped_ = false;  // by the program
  bool is_woken_ = false;    // the next tick comes before its deadline
  Pace pace_;
  std::uint64_t deadline_;  // number of the deadline that the next tick waits for
  std::uint64_t skipped_before_ = 0;
  std::size_t cuts_ = 0;  // that have been
  RunEnd end_;
};

}  // namespace

RunEnd run_loop(Run& run, Clock& clock, const LoopOptions& options,
                std::span<Observer* const> observers) {
  return Loop(run, clock, options, observers).run();
}

}  // namespace lockstep::host
