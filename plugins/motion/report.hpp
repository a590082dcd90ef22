// The progress that an action reports instead of its own: an older one, as a slow sensor or a
// network gives it, or one in steps.
#pragma once

#include <lockstep/leaf.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "curve.hpp"
#include "pace.hpp"

namespace motion {

// A part of the ports of an action.
struct ReportPorts {
  explicit constexpr ReportPorts(lockstep::Ports* owner)
      : latency(owner, "latency", "0",
                "how old the reported progress is, also while the action is held; of what moves in "
                "ticks whole ticks, rounded up. 0 before the start",
                "s", lockstep::Ports::at_least(0)),
        quantize(owner, "quantize", "0",
                 "the reported progress is rounded down to a multiple of this; 0: it is not",
                 lockstep::Ports::between(0, 1)) {}

  // The reported value is always the progress itself.
  bool is_plain() const { return is_always_0(latency) && is_always_0(quantize); }

  lockstep::Input<double> latency, quantize;

 private:
  static bool is_always_0(const lockstep::Input<double>& port) {
    return port.is_constant() && port.get() == 0;
  }
};

class Report {
 public:
  void start(const ReportPorts& ports) {
    latency_ = ports.latency.get();
    step_ = ports.quantize.get();
    samples_.clear();
    if (is_late()) samples_.reserve(kUsual);
  }

  // Else there is nothing to sample, and the report needs no time.
  bool is_late() const { return latency_ != 0; }

  // Call before each tick of an action that moves in ticks, and when it is paused: a held action
  // stands still, but what it reports goes on until it is up to date.
  void sample(double now, double progress) {
    if (!is_late()) return;
    const auto after = first_after(now - latency_);
    if (after != samples_.begin()) samples_.erase(samples_.begin(), after - 1);
    samples_.push_back({now, progress});
  }

  // The report of an action that moves in ticks and has this progress now.
  double of_ticks(double now, double progress) const {
    if (!is_late()) return in_steps(progress);
    const auto after = first_after(now - latency_);
    return after == samples_.begin() ? 0 : in_steps((after - 1)->progress);
  }

  // The report of an action whose progress is known for each time of its pace.
  template <class ProgressAt>
  double of(const Pace& pace, double now, ProgressAt progress_at) const {
    const double elapsed = pace.elapsed(now);
    if (!pace.is_time()) return of_ticks(now, progress_at(elapsed));
    const double then = elapsed - latency_;
    return then < -kSameTime ? 0 : in_steps(progress_at(std::max(0.0, then)));
  }

 private:
  // The clock has whole nanoseconds, and so has each of its ticks.
  static constexpr double kSameTime = 1e-6;   // s
  static constexpr std::size_t kUsual = 128;  // samples; more grow once

  std::vector<Point>::const_iterator first_after(double time) const {
    return std::upper_bound(samples_.begin(), samples_.end(), time + kSameTime,
                            [](double value, const Point& sample) { return value < sample.at; });
  }
  double in_steps(double progress) const {
    return step_ > 0 ? std::min(1.0, std::floor(progress / step_ + 1e-9) * step_) : progress;
  }

  double latency_ = 0, step_ = 0;
  std::vector<Point> samples_;  // of the last `latency`, and one before
};

}  // namespace motion
