#include "upkeep.hpp"

#include <algorithm>
#include <stdexcept>

namespace fetch {

Charge::Status Charge::tick() {
  World& world = context<World>();
  if (world.at != &World::place("dock")) return fail("the robot is not at the dock");
  if (world.battery >= level.get()) return Status::Success;
  world.battery = std::min(1.0, world.battery + rate.get() * tick_period());
  return world.battery >= std::min(1.0, level.get()) ? Status::Success : Status::Running;
}

double Charge::progress() const {
  const double whole = level.get() - from_;
  return whole > 0 ? (context<World>().battery - from_) / whole : 1;
}

void Say::start() {
  if (!(rate.get() > 0)) throw std::runtime_error("port 'rate' must be greater than 0");
  timer_.start(static_cast<double>(text.view().size()) / rate.get());
  log("says: " + text.get());
}

Say::Status Say::tick() {
  return timer_.step(tick_period()) ? Status::Success : Status::Running;
}

}  // namespace fetch
