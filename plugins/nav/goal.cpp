#include "goal.hpp"

#include <utility>

namespace nav {

using Status = lockstep::Status;

bool GoalUpdated::check() {
  const bool is_updated = changed();
  return !last_tick_.is_after_gap(tick_number()) && is_updated;
}

bool GlobalUpdatedGoal::check() {
  const bool is_updated = changed();
  return std::exchange(is_first_, false) || is_updated;
}

// A child that runs works for the goal before, and begins again. One that fails is started again
// with the next tick.
Status GoalUpdatedController::tick() {
  is_due_ |= changed();
  is_due_ |= last_tick_.is_after_gap(tick_number());
  const bool is_running = child_status() == Status::Running;
  if (!is_due_ && !is_running) return Status::Running;
  if (is_due_ && is_running) halt_child();
  const Status status = tick_child();
  is_due_ = status == Status::Failure;
  return status;
}

bool PathExpiringTimer::check() {
  const bool is_another = path.changed();
  const bool begins = std::exchange(is_first_, false) || is_another;
  const bool is_over = !begins && now() - began_ >= seconds.get() - kRounding;
  if (begins || is_over) began_ = now();
  return is_over;
}

}  // namespace nav
