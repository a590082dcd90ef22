// Tells the thread that ticks that its tick lasts, so that it needs to time calls only then:
// between them, the thread takes no lock and makes no system call. Another thread looks
// (run/watchdog.h), once in each period while ticks come in time.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "base/core/clock.h"
#include "base/system/fork_guard.h"
#include "base/system/mutex.h"

namespace lockstep::host {

class TickAlarm {
 public:
  // It rings when a tick has lasted for `delay`. Ticks are expected in each period.
  TickAlarm(Nanoseconds delay, Nanoseconds period) : delay_(delay), period_(period) {}
  TickAlarm(const TickAlarm&) = delete;
  TickAlarm& operator=(const TickAlarm&) = delete;

  // --- for the thread that ticks -----------------------------------------------------------------

  void begin_tick(Nanoseconds now) {
    tick_.store((now.count() << 1) | kLasts, std::memory_order_release);
  }
  void end_tick() {
    tick_.store(tick_.load(std::memory_order_relaxed) & ~kLasts, std::memory_order_release);
  }
  // When it rang in this tick.
  std::optional<Nanoseconds> rang() const {
    if (rang_in_.load(std::memory_order_acquire) != tick_.load(std::memory_order_relaxed))
        [[likely]]
      return std::nullopt;
    return Nanoseconds(rang_at_.load(std::memory_order_relaxed));
  }
  // Cleared when it rings; null: nothing. Not in a tick.
  void attach(ForkGuard::Byte* byte) {
    const Lock lock(mutex_);
    byte_ = byte;
  }

  // --- for the thread that looks -----------------------------------------------------------------

  // Returns when to look next.
  Nanoseconds look(Nanoseconds now);

 private:
  static constexpr std::int64_t kLasts = 1;

  // Where ticks come more often than it could look at each of them, it looks less often: then it is
  // known to within two delays when a tick began to last.
  Nanoseconds least_wait() const { return period_ < delay_ ? 2 * delay_ : delay_; }

  void ring(std::int64_t tick, Nanoseconds now);

  const Nanoseconds delay_, period_;
  std::atomic<std::int64_t> tick_{0};  // its begin in ns, times 2; and kLasts
  std::atomic<std::int64_t> rang_in_{-1}, rang_at_{0};
  Mutex mutex_;
  ForkGuard::Byte* byte_ LOCKSTEP_GUARDED_BY(mutex_) = nullptr;
};

}  // namespace lockstep::host
