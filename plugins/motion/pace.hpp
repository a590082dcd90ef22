// The time of an action that plays a progress: the ticks that it receives, or the seconds since its
// start, which also pass while it is held.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace motion {

inline constexpr double kDone = 1 - 1e-9;  // ten steps of 0.1 are one
inline constexpr const char* kClockDoc =
    "what moves it on: ticks, those that it receives; time, seconds, also while it is held";

class Pace {
 public:
  void start(std::string_view clock, double now) {
    is_time_ = clock == "time";
    if (!is_time_ && clock != "ticks") {
      throw std::runtime_error("port 'clock' is neither 'ticks' nor 'time'");
    }
    start_ = now;
    ticks_ = 0;
  }
  void tick() { ++ticks_; }
  // Ticks or seconds.
  double elapsed(double now) const { return is_time_ ? now - start_ : static_cast<double>(ticks_); }
  // The same within the tolerance of progress.
  bool has_reached(double end, double now) const { return elapsed(now) >= end - 1e-9; }
  bool is_time() const { return is_time_; }

 private:
  bool is_time_ = false;
  double start_ = 0;  // s
  std::int64_t ticks_ = 0;
};

}  // namespace motion
