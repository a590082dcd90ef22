// The time of an action that plays a progress: the ticks that it receives, or the seconds since its
// start, which also pass while it is held.
#pragma once

#include <lockstep/leaf.hpp>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace motion {

inline constexpr double kDone = 1 - 1e-9;  // ten steps of 0.1 are one
inline constexpr const char* kClockDoc =
    "what moves it on: ticks, those that it receives; time, seconds, also while it is held";

// How an action obeys the factor that a node with pace="true" gives it.
struct ObeyPorts {
  explicit constexpr ObeyPorts(lockstep::Ports* owner)
      : paces(owner, "paces", "true", "it moves slower when a node with pace=\"true\" slows it"),
        least_pace(owner, "least_pace", "0", "it cannot move slower than this share of its speed",
                   lockstep::Ports::between(0, 1)),
        pace_latency(owner, "pace_latency", "0", "how long a new speed takes to act", "s",
                     lockstep::Ports::at_least(0)) {}

  lockstep::Input<bool> paces;
  lockstep::Input<double> least_pace, pace_latency;
};

class Obey {
 public:
  void start(const ObeyPorts& ports) {
    least_ = ports.paces.get() ? ports.least_pace.get() : 1;
    latency_ = ports.pace_latency.get();
    factor_ = 1;
    is_told_ = false;
    told_.clear();
  }
  // What it takes up.
  double set(double factor, double now) {
    const double taken = std::max(factor, least_);
    is_told_ = true;
    told_.push_back({now + latency_, taken});
    return taken;
  }
  // Else it moves as fast as ever.
  bool is_told() const { return is_told_; }
  // How fast it moves now.
  [[gnu::noinline]] double factor(double now) {
    const auto acts = [now](const Told& told) { return told.from <= now + kSameTime; };
    while (!told_.empty() && acts(told_.front())) {
      factor_ = told_.front().factor;
      told_.erase(told_.begin());
    }
    return factor_;
  }

 private:
  static constexpr double kSameTime = 1e-6;  // s
  struct Told {
    double from, factor;
  };
  double least_ = 0, latency_ = 0, factor_ = 1;
  bool is_told_ = false;    // in this activation
  std::vector<Told> told_;  // what does not act yet
};

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
  // A tick at this share of its speed.
  void tick(double factor) { ticks_ += factor; }
  // Ticks or seconds.
  double elapsed(double now) const { return is_time_ ? now - start_ : ticks_; }
  // The same within the tolerance of progress.
  bool has_reached(double end, double now) const { return elapsed(now) >= end - 1e-9; }
  bool is_time() const { return is_time_; }

 private:
  bool is_time_ = false;
  double start_ = 0;  // s
  double ticks_ = 0;
};

}  // namespace motion
