#include "driving.hpp"

namespace fetch {
namespace {

constexpr double kBatteryPerMeter = 0.01;

}  // namespace

bool At::check() {
  return context<World>().at == &World::place(place.view());
}

bool DoorOpen::check() {
  return context<World>().door(door.view()).is_open || fail("it is closed");
}

OpenDoor::Status OpenDoor::tick() {
  World& world = context<World>();
  Door& it = world.door(door.view());
  if (it.is_open) return Status::Success;
  if (world.at != &World::place(it.place)) return fail("the robot is not at the door");
  if (!timer_.step(tick_period())) return Status::Running;
  it.is_open = random() >= failure.get();
  return it.is_open ? Status::Success : fail("the door does not open");
}

void DriveTo::start() {
  const World& world = context<World>();
  route_ = world.route_to(World::place(place.view()));
  next_ = 0;
  length_ = length_left(world);
}

double DriveTo::length_left(const World& world) const {
  double length = 0;
  Point from = world.position;
  for (std::size_t i = next_; i < route_.size(); ++i) {
    length += distance(from, route_[i].point);
    from = route_[i].point;
  }
  return length;
}

// Moves on by up to `step` meters; false at a closed door.
bool DriveTo::advance(World& world, double step) {
  while (next_ < route_.size()) {
    const Waypoint& to = route_[next_];
    const double left = distance(world.position, to.point);
    if (left > step) {
      world.position.x += (to.point.x - world.position.x) * step / left;
      world.position.y += (to.point.y - world.position.y) * step / left;
      return true;
    }
    if (to.door && !to.door->is_open) return false;
    world.position = to.point;
    world.room = to.room;
    step -= left;
    ++next_;
  }
  return true;
}

DriveTo::Status DriveTo::tick() {
  World& world = context<World>();
  const Place& goal = World::place(place.view());
  if (world.at == &goal) return Status::Success;
  if (world.battery <= 0) return fail("the battery is empty");
  world.at = nullptr;
  const double before = length_left(world);
  const bool is_free = advance(world, speed.get() * tick_period());
  world.battery -= kBatteryPerMeter * (before - length_left(world));
  if (!is_free) {
    const std::string reason = "the door on the way to " + place.get() + " is closed";
    log(reason);
    return fail(reason);
  }
  if (next_ < route_.size()) return Status::Running;
  world.at = &goal;
  return Status::Success;
}

double DriveTo::progress() const {
  return length_ > 0 ? 1 - length_left(context<World>()) / length_ : 1;
}

}  // namespace fetch
