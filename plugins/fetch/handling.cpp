#include "handling.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace fetch {
namespace {

double arm_at(std::string_view pose) {
  if (pose == "stow") return 0;
  if (pose == "carry") return 0.4;
  if (pose == "reach") return 1;
  throw std::runtime_error("port 'pose' is neither 'stow' nor 'carry' nor 'reach'");
}

}  // namespace

bool Holding::check() {
  World& world = context<World>();
  return world.held == &world.object(object.view());
}

bool ObjectSeen::check() {
  const Object& it = context<World>().object(object.view());
  if (!it.is_known || !it.place) return false;
  place.set(std::string(it.place->name));
  return true;
}

LookFor::Status LookFor::tick() {
  World& world = context<World>();
  Object& it = world.object(object.view());
  if (!timer_.step(tick_period())) return Status::Running;
  if (!it.place || it.place->room != world.room) {
    return fail("there is no " + object.get() + " in this room");
  }
  it.is_known = true;
  place.set(std::string(it.place->name));
  log("sees the " + object.get() + " at the " + std::string(it.place->name));
  return Status::Success;
}

Grasp::Status Grasp::tick() {
  World& world = context<World>();
  Object& it = world.object(object.view());
  if (world.held == &it) return Status::Success;
  if (world.held) return fail("the gripper is not empty");
  if (!world.at || it.place != world.at)
    return fail("the " + object.get() + " is not within reach");
  if (!timer_.step(tick_period())) return Status::Running;
  if (random() < failure.get()) {
    const std::string reason = "the gripper misses the " + object.get();
    log(reason);
    return fail(reason);
  }
  world.held = &it;
  it.place = nullptr;
  return Status::Success;
}

PutDown::Status PutDown::tick() {
  World& world = context<World>();
  if (!world.held) return fail("the gripper holds nothing");
  if (!world.at) return fail("the robot is between two places");
  if (!timer_.step(tick_period())) return Status::Running;
  world.held->place = world.at;
  world.held->is_known = true;
  world.held = nullptr;
  return Status::Success;
}

void MoveArm::start() {
  goal_ = arm_at(pose.view());
  way_ = std::abs(goal_ - context<World>().arm);
}

MoveArm::Status MoveArm::tick() {
  World& world = context<World>();
  const double step = speed.get() * tick_period();
  const double left = goal_ - world.arm;
  if (std::abs(left) > step) {
    world.arm += std::copysign(step, left);
    return Status::Running;
  }
  world.arm = goal_;
  return Status::Success;
}

double MoveArm::progress() const {
  return way_ > 0 ? 1 - std::abs(goal_ - context<World>().arm) / way_ : 1;
}

}  // namespace fetch
