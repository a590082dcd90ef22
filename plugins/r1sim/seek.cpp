#include "seek.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "world.hpp"

namespace r1sim {
namespace {

double positive(const char* port, double value) {
  if (value > 0) return value;
  throw std::runtime_error("port '" + std::string(port) + "' must be greater than 0");
}

HallwayScene& advanced(World& world) {
  if (!(world.hallway.length() > 0)) {
    throw std::runtime_error("there is no hallway: 'EnterHallway' must come first");
  }
  world.hallway.advance();
  return world.hallway;
}

}  // namespace

EnterHallway::Status EnterHallway::tick() {
  Hallway hallway;
  hallway.length = positive("length", length.get());
  hallway.objects = objects.get();
  hallway.identify_min = identify_min.get();
  hallway.identify_max = identify_max.get();
  if (hallway.identify_min < 0 || hallway.identify_max < hallway.identify_min) {
    throw std::runtime_error("ports 'identify_min' and 'identify_max' are no interval of times");
  }
  context<World>().hallway.furnish(hallway);
  return Status::Success;
}

HallwayScene& Swipe::scene() const {
  return advanced(context<World>());
}

void Swipe::start() {
  Head head;
  head.speed = positive("speed", speed.get());
  head.stripe = positive("stripe", stripe.get());
  head.reach = reach.get();
  head.moves = true;
  scene().begin_sweep(head);
  told_missed_ = 0;
}

Swipe::Status Swipe::tick() {
  HallwayScene& now = scene();
  tell(now);
  if (now.head.swept < now.length()) return Status::Running;
  now.head.moves = false;
  return Status::Success;
}

void Swipe::tell(const HallwayScene& now) {
  identified.set(now.identified());
  missed.set(now.missed());
  if (now.missed() == told_missed_) return;
  told_missed_ = now.missed();
  log(lockstep::LogLevel::Warning, std::to_string(told_missed_) + " missed so far: out of view");
}

double Swipe::progress() const {
  const HallwayScene& now = scene();
  return now.head.swept / now.length();
}

HallwayScene& Navigate::scene() const {
  return advanced(context<World>());
}

void Navigate::start() {
  Base& base = scene().base;
  base.speed = positive("speed", speed.get());
  base.traveled = 0;
  base.moves = true;
}

Navigate::Status Navigate::tick() {
  HallwayScene& now = scene();
  if (now.base.traveled < now.length()) return Status::Running;
  now.base.moves = false;
  return Status::Success;
}

double Navigate::progress() const {
  const HallwayScene& now = scene();
  return now.base.traveled / now.length();
}

bool MissedAtMost::check() {
  return advanced(context<World>()).missed() <= count.get();
}

}  // namespace r1sim
