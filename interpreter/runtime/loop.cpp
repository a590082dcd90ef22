#include "runtime/loop.h"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

// A stop signal that comes between the look at it and the sleep does not end the sleep.
constexpr Nanoseconds kLongestSleep = std::chrono::milliseconds(100);

// deadline_of at one rate. Where the period is a whole number of nanoseconds, as at 100 Hz, the
// product is the same number: a division can take longer than the tick of a small tree.
class Deadlines {
 public:
  explicit Deadlines(double rate) : rate_(rate) {
    const double period = 1e9 / rate;
    const bool is_whole = period == std::floor(period) && std::fma(period, rate, -1e9) == 0;
    if (is_whole) period_ = static_cast<std::uint64_t>(period);
  }

  Nanoseconds at(std::uint64_t k) const {
    return period_ != 0 ? Nanoseconds(k * period_) : deadline_of(k, rate_);
  }

 private:
  double rate_;
  std::uint64_t period_ = 0;  // 0: not whole
};

class Loop {
 public:
  Loop(Run& run, Clock& clock, const LoopOptions& options, std::span<Observer* const> observers)
      : run_(run),
        clock_(clock),
        options_(options),
        observers_(observers),
        deadlines_(options.rate),
        is_real_(clock.is_real()),
        start_(clock.now()) {}

  RunEnd run() {
    for (Observer* observer : observers_) {
      observer->run_started(run_.ticker(), {run_.period(), is_real_});
    }
    if (run_.fault() != nullptr) end_.reason = StopReason::Fault;
    while (run_.fault() == nullptr && may_tick() && tick()) wait_for_next();
    end_.time = clock_.now() - start_;
    run_.halt();
    for (Observer* observer : observers_) observer->run_ended(run_.ticker(), end_);
    return end_;
  }

 private:
  bool may_tick() {
    if (stop_requested()) {
      end_.signal = options_.stop_signal();
      return stop(StopReason::Signal);
    }
    if (options_.max_ticks && end_.ticks >= *options_.max_ticks) return stop(StopReason::MaxTicks);
    if (options_.timeout && clock_.now() - start_ >= *options_.timeout) {
      return stop(StopReason::Timeout);
    }
    return true;
  }

  bool stop_requested() const {
    return options_.stop_signal != nullptr && options_.stop_signal() != 0;
  }

  bool stop(StopReason reason) {
    end_.reason = reason;
    return false;
  }

  // True while the run goes on.
  bool tick() {
    const Nanoseconds now = clock_.now() - start_;
    Ticker& ticker = run_.ticker();
    run_.set_now(now);
    for (Observer* observer : observers_) observer->before_tick(ticker, end_.ticks, now);
    end_.status = run_.tick(now);
    const TickReport report{end_.ticks, now, end_.status, skipped_before_};
    for (Observer* observer : observers_) observer->after_tick(ticker, report);
    ++end_.ticks;
    if (run_.fault() != nullptr) return stop(StopReason::Fault);
    if (is_complete(end_.status)) return stop(StopReason::Completed);
    return true;
  }

  void wait_for_next() {
    ++deadline_;
    skipped_before_ = 0;
    if (is_real_) skip_missed();
    const Nanoseconds deadline = start_ + deadlines_.at(deadline_);
    do {  // any signal ends a sleep, only a stop signal ends the wait
      clock_.sleep_until(is_real_ ? std::min(deadline, clock_.now() + kLongestSleep) : deadline);
    } while (clock_.now() < deadline && !stop_requested());
  }

  void skip_missed() {
    const Nanoseconds late = clock_.now() - start_ - deadlines_.at(deadline_);
    if (late < Nanoseconds(0)) return;
    ++end_.overruns;
    const auto passed = static_cast<std::uint64_t>(to_seconds(late) * options_.rate) + 1;
    deadline_ += passed;
    end_.skipped += skipped_before_ = passed;
  }

  Run& run_;
  Clock& clock_;
  const LoopOptions& options_;
  std::span<Observer* const> observers_;
  const Deadlines deadlines_;
  const bool is_real_;
  const Nanoseconds start_;
  std::uint64_t deadline_ = 0;  // number of the deadline that the next tick waits for
  std::uint64_t skipped_before_ = 0;
  RunEnd end_;
};

}  // namespace

Nanoseconds deadline_of(std::uint64_t k, double rate) {
  return Nanoseconds(std::llround(static_cast<long double>(k) * 1e9L / rate));
}

RunEnd run_loop(Run& run, Clock& clock, const LoopOptions& options,
                std::span<Observer* const> observers) {
  return Loop(run, clock, options, observers).run();
}

}  // namespace lockstep
