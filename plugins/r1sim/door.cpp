#include "door.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "world.hpp"

namespace r1sim {
namespace {

void move(DoorMotion& part, double seconds) {
  if (part.moves) part.moved = std::min(part.way, part.moved + part.pace * part.speed * seconds);
}

}  // namespace

void DoorScene::advance() {
  const double seconds = run_.now() - time_;
  time_ = run_.now();
  if (!(seconds > 0) || has_jammed_) return;
  move(hand, seconds);
  move(base, seconds);
  has_jammed_ = std::abs(hand.moved - base.moved) > slack_;
}

void DoorScene::close(double slack) {
  slack_ = slack;
  has_jammed_ = false;
  is_told = false;
}

template <class Ports, DoorMotion DoorScene::*kPart>
DoorScene& DoorAction<Ports, kPart>::scene() const {
  DoorScene& scene = this->template context<World>().door;
  scene.advance();
  return scene;
}

template <class Ports, DoorMotion DoorScene::*kPart>
void DoorAction<Ports, kPart>::start() {
  DoorMotion& part = motion();
  part.way = this->way.get();
  if (!(part.way > 0)) throw std::runtime_error("port 'way' must be greater than 0");
  part.speed = this->speed.get() * (1 + this->spread.get() * this->uniform(-1, 1));
  part.moved = 0;
  part.pace = 1;
  part.moves = true;
}

template <class Ports, DoorMotion DoorScene::*kPart>
typename DoorAction<Ports, kPart>::Status DoorAction<Ports, kPart>::tick() {
  DoorScene& now = scene();
  DoorMotion& part = now.*kPart;
  if (!now.has_jammed() && part.moved < part.way) return Status::Running;
  part.moves = false;
  if (!now.has_jammed()) return Status::Success;
  const std::string reason = "the door jams: the hand has moved " + std::to_string(now.hand.moved) +
                             " m, the base " + std::to_string(now.base.moved) + " m";
  if (!std::exchange(now.is_told, true)) this->log(lockstep::LogLevel::Warning, reason);
  return this->fail(reason);
}

void PullDoor::start() {
  scene().close(slack.get());
  DoorAction::start();
}

template class DoorAction<PullDoorPorts, &DoorScene::hand>;
template class DoorAction<BackAwayPorts, &DoorScene::base>;

}  // namespace r1sim
