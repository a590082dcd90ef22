#include "base/system/tick_alarm.h"

#include <algorithm>

namespace lockstep::host {

Nanoseconds TickAlarm::look(Nanoseconds now) {
  const std::int64_t tick = tick_.load(std::memory_order_acquire);
  const Nanoseconds begun(tick >> 1);
  const Nanoseconds expected = begun + period_;
  if ((tick & kLasts) != 0 && rang_in_.load(std::memory_order_relaxed) != tick) {
    const bool is_new = now - begun < delay_ - delay_ / 4;
    if (is_new) return period_ < delay_ ? now + least_wait() : begun + delay_;
    ring(tick, now);
  }
  if (now < expected) return std::max(expected + delay_, now + least_wait());
  // The next tick is late; or there is none, as in a pause.
  return now + (now - expected < period_ ? least_wait() : std::max(period_, least_wait()));
}

void TickAlarm::ring(std::int64_t tick, Nanoseconds now) {
  const Lock lock(mutex_);
  rang_at_.store(now.count(), std::memory_order_relaxed);
  rang_in_.store(tick, std::memory_order_release);
  if (byte_ != nullptr) byte_->clear();
}

}  // namespace lockstep::host
