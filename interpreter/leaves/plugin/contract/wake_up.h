// Ends the wait of a run for its next period, from any thread.
#pragma once

#include <functional>
#include <utility>

#include "base/system/bell.h"

namespace lockstep::host {

class WakeUp {
 public:
  // `on_wake`: of an owner that waits in its own way; from any thread.
  explicit WakeUp(std::function<void()> on_wake = {}) : on_wake_(std::move(on_wake)) {}

  void wake() {
    bell_.ring();
    if (on_wake_) on_wake_();
  }

  // For who waits: it is due when this is another number than before the last tick.
  std::uint32_t wakes() const { return bell_.rung(); }
  void wait(std::uint32_t seen, Nanoseconds longest) { bell_.wait(seen, longest); }

 private:
  Bell bell_;
  const std::function<void()> on_wake_;
};

}  // namespace lockstep::host
