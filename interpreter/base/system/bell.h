// One thread waits, any other rings: a futex. Ringing never waits and is async-signal-safe; it is a
// system call, so not for each tick.
#pragma once

#include "base/system/futex.h"

namespace lockstep::host {

class Bell {
 public:
  // How often it has been rung. Read this before checking for work, then wait for more.
  std::uint32_t rung() const { return rung_.load(std::memory_order_acquire); }
  void ring() {
    rung_.fetch_add(1, std::memory_order_release);
    futex_wake(rung_);
  }
  // Returns once it has been rung since `seen`, or after `longest`, or spuriously.
  void wait(std::uint32_t seen, Nanoseconds longest) { futex_wait(rung_, seen, longest); }

 private:
  std::atomic<std::uint32_t> rung_{0};
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);
};

}  // namespace lockstep::host
