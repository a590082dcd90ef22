#include "simulated.hpp"

#include <algorithm>

namespace nav {

using Status = lockstep::Status;

Status ComputePathToPose::tick() {
  Robot& robot = context<Robot>();
  if (robot.left == Robot::kUnknown) robot.left = distance.get();
  robot.is_blocked = robot.is_blocked || random() < failure.get();
  if (robot.is_blocked) {
    log("no path: the costmap is blocked");
    return Status::Failure;
  }
  path.set(robot.left);
  return Status::Success;
}

void DrivePath::start() {
  whole_ = context<Robot>().left;
}

Status DrivePath::tick() {
  Robot& robot = context<Robot>();
  if (robot.left == Robot::kUnknown) return Status::Failure;  // no path yet
  if (robot.left <= 0) return Status::Success;
  robot.is_stuck = robot.is_stuck || random() < failure.get() * tick_period();
  if (robot.is_stuck) {
    log("stuck");
    return Status::Failure;
  }
  robot.left = std::max(0.0, robot.left - speed.get() * tick_period());
  return robot.left > 0 ? Status::Running : Status::Success;
}

double DrivePath::progress() const {
  return whole_ > 0 ? 1 - context<Robot>().left / whole_ : 1;
}

Status ClearEntireCostmap::tick() {
  context<Robot>().is_blocked = false;
  return Status::Success;
}

Status Maneuver::tick() {
  done_ += tick_period();
  if (done_ < seconds.get()) return Status::Running;
  Robot& robot = context<Robot>();
  if (random() < success.get()) robot.is_stuck = false;
  return Status::Success;
}

}  // namespace nav
