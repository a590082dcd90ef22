#include "pace.hpp"

#include <algorithm>
#include <cmath>

namespace nav {

using Status = lockstep::Status;

Status RateController::tick() {
  const double period = 1 / hz.get();
  const bool is_first = begins();
  if (is_first) began_ = now();
  const bool is_due = is_first || child_runs() || now() - began_ >= period - kRounding;
  if (!is_due) return Status::Running;
  const Status status = tick_child();
  if (status == Status::Success) began_ = now();
  return status;
}

// For another goal the child is started at once.
Status SpeedController::tick() {
  const double rate_now = rate();
  const bool is_another = changed();
  const bool is_first = begins() || is_another;
  if (is_first) began_ = now(), period_ = 1 / max_rate.get();
  const bool is_over = now() - began_ >= period_ - kRounding;
  if (!is_first && !is_over && !child_runs()) return Status::Running;
  if (is_over) began_ = now(), period_ = 1 / rate_now;
  return tick_child();
}

double SpeedController::rate() const {
  const double low = min_rate.get(), high = max_rate.get();
  const double above = std::abs(speed.get()) - min_speed.get();
  const double range = max_speed.get() - min_speed.get();
  if (range == 0) return above >= 0 ? high : low;
  return std::max(low, std::min(high, low + above / range * (high - low)));
}

Status DistanceController::tick() {
  const double to_x = x.get(), to_y = y.get();
  const bool is_first = begins();
  if (is_first) from_x_ = to_x, from_y_ = to_y;
  const double distance_done = std::hypot(to_x - from_x_, to_y - from_y_);
  const bool is_due = is_first || child_runs() || distance_done >= distance.get() - kRounding;
  if (!is_due) return Status::Running;
  const Status status = tick_child();
  if (status == Status::Success) from_x_ = to_x, from_y_ = to_y;
  if (status == Status::Failure) reset();
  return status;
}

}  // namespace nav
