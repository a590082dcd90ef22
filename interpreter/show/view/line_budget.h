// How many lines may be printed: a burst at once, then one for each second of real time, so that a
// fast run cannot flood the reader. Used by console_plain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/core/clock.h"

namespace lockstep::host {

class LineBudget {
 public:
  explicit LineBudget(std::int64_t burst) : burst_(burst), left_(burst) {}

  // True if a line may be printed at `now`; else it is counted as left out.
  bool take(Nanoseconds now) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(now - refilled_);
    if (seconds.count() > 0) {
      left_ =
          std::min<std::int64_t>(burst_, left_ + std::min<std::int64_t>(burst_, seconds.count()));
      refilled_ = now;
    }
    if (left_ > 0) {
      --left_;
      return true;
    }
    ++left_out_;
    return false;
  }
  // Lines left out since the last call.
  std::uint64_t take_left_out() { return std::exchange(left_out_, 0); }

 private:
  std::int64_t burst_, left_;
  std::uint64_t left_out_ = 0;
  Nanoseconds refilled_{0};
};

}  // namespace lockstep::host
