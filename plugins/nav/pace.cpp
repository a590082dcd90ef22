#include "pace.hpp"

#include <algorithm>
#include <cmath>

namespace nav {

using Status = lockstep::Status;

// For another goal the child is started at once.
Status SpeedController::tick() {
  if (changed()) begin();
  return tick_at(rate());
}

double SpeedController::rate() const {
  const double least = min_speed.get(), range = max_speed.get() - least;
  const double above = std::abs(speed.get()) - least;
  const double share = range > 0 ? std::clamp(above / range, 0.0, 1.0) : above >= 0 ? 1.0 : 0.0;
  return min_rate.get() + share * (max_rate.get() - min_rate.get());
}

// A child that fails is started again with the next tick.
Status DistanceController::tick() {
  const double to_x = x.get(), to_y = y.get();
  is_first_ |= last_tick_.is_after_gap(tick_number());
  if (is_first_) from_x_ = to_x, from_y_ = to_y;
  const double way = std::hypot(to_x - from_x_, to_y - from_y_);
  const bool is_due = is_first_ || way >= distance.get() - kRounding;
  if (!is_due && child_status() != Status::Running) return Status::Running;
  const Status status = tick_child();
  is_first_ = status == Status::Failure;
  if (status == Status::Success) from_x_ = to_x, from_y_ = to_y;
  return status;
}

}  // namespace nav
