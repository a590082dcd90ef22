#include "manipulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace r1sim {

void DoTask::start() {
  if (min_speed.get() < 0 || max_speed.get() < min_speed.get()) {
    throw std::runtime_error("ports 'min_speed' and 'max_speed' are no interval of speeds");
  }
  if (!(change_time.get() > 0)) {
    throw std::runtime_error("port 'change_time' must be greater than 0");
  }
  progress_ = 0;
  until_change_ = 0;
}

// It works for one period per tick that it receives, so a task that is held stands still.
DoTask::Status DoTask::tick() {
  double left = tick_period();
  while (left > 0) {
    if (!(until_change_ > 0)) {
      speed_ = uniform(min_speed.get(), max_speed.get());
      until_change_ = -change_time.get() * std::log(1 - random());
    }
    const double step = std::min(left, until_change_);
    progress_ += speed_ * step;
    until_change_ -= step;
    left -= step;
  }
  if (progress_ < 1) return Status::Running;
  return Status::Success;
}

}  // namespace r1sim
