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

// A child that runs is not begun again for another goal: it sees that goal itself.
Status GoalUpdatedController::tick() {
  const bool is_another = changed();
  if (!begins() && !is_another && !child_runs()) return Status::Running;
  const Status status = tick_child();
  if (status == Status::Failure) reset();
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
