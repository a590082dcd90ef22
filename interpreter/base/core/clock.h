// The time of a run. All of lockstep takes time from a Clock: the wall clock on a robot, the
// virtual clock in tests, studies and `--clock virtual`.
#pragma once

#include <chrono>

namespace lockstep::host {

using Nanoseconds = std::chrono::nanoseconds;

// CLOCK_MONOTONIC. Async-signal-safe.
Nanoseconds monotonic_now();

constexpr double to_seconds(Nanoseconds time) {
  return static_cast<double>(time.count()) / 1e9;
}

// Rounded to the nearest nanosecond. `seconds` must be within +-9.2e9.
constexpr Nanoseconds from_seconds(double seconds) {
  return Nanoseconds(static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5)));
}

class Clock {
 public:
  virtual ~Clock() = default;
  // Monotonic; the origin is arbitrary.
  virtual Nanoseconds now() = 0;
  // Returns at `deadline` (a value of now()), or earlier when a signal arrives; at once when it
  // has passed.
  virtual void sleep_until(Nanoseconds deadline) = 0;
  // False for a clock whose time does not pass by itself, so that periods and lateness have no
  // meaning.
  virtual bool is_real() const = 0;
};

// CLOCK_MONOTONIC, with absolute deadlines.
class WallClock final : public Clock {
 public:
  Nanoseconds now() override { return monotonic_now(); }
  void sleep_until(Nanoseconds deadline) override;
  bool is_real() const override { return true; }
};

// Stands still except in sleep_until, which jumps to the deadline.
class VirtualClock final : public Clock {
 public:
  Nanoseconds now() override { return now_; }
  void sleep_until(Nanoseconds deadline) override {
    if (deadline > now_) now_ = deadline;
  }
  bool is_real() const override { return false; }

 private:
  Nanoseconds now_{0};
};

}  // namespace lockstep::host
