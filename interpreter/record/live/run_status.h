// The state of the run as a whole, for listeners: whether it is paused, its speed, where it will
// pause, how long ticks take.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "record/live/line_feed.h"
#include "run/run_control.h"

namespace lockstep::host {

class RunStatus {
 public:
  static constexpr std::chrono::milliseconds kPeriod{200};

  // A breakpoint was set or removed.
  void note(Breakpoint breakpoint, bool is_on);
  // As JSON, if listeners are to be told now: at once if something has changed, except for the
  // times of ticks.
  std::optional<std::string> next(const RunControl::State& state, LineFeed& feed, bool is_real_time,
                                  Nanoseconds now);

 private:
  std::optional<RunControl::State> told_ = {};
  Nanoseconds told_at_{0};
  std::vector<Breakpoint> breakpoints_;
  bool is_changed_ = false;
};

}  // namespace lockstep::host
