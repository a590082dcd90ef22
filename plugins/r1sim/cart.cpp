#include "cart.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "world.hpp"

namespace r1sim {
namespace {

Drift drift_of(double rms_slope, double length, double correction_rate) {
  if (!(length > 0)) throw std::runtime_error("port 'drift_length' must be greater than 0");
  Drift drift;
  drift.rms_slope = rms_slope;
  drift.length = length;
  drift.correction_rate = correction_rate;
  return drift;
}

}  // namespace

// The exact step of a mean-reverting random walk, so that its statistics do not depend on the rate.
void Drift::roll(double distance, lockstep::Run& run) {
  const double kept = std::exp(-distance / length);
  const double unit = run.uniform(-std::sqrt(3.0), std::sqrt(3.0));  // variance 1
  slope = kept * slope + rms_slope * std::sqrt(1 - kept * kept) * unit;
  error += slope * distance;
}

void Drift::correct(double seconds) {
  const double step = correction_rate * seconds;
  error -= std::clamp(error, -step, step);
}

void CartScene::advance() {
  const double seconds = run_.now() - time_;
  time_ = run_.now();
  if (!(seconds > 0)) return;
  if (base_moves) {
    const double distance = speed * seconds;
    traveled += distance;
    base.roll(distance, run_);
    base.correct(seconds);
    cart.roll(distance, run_);
  }
  if (arms_align) cart.correct(seconds);
}

CartScene& HoldCart::scene() const {
  CartScene& scene = context<World>().cart;
  scene.advance();
  return scene;
}

void HoldCart::start() {
  CartScene& now = scene();
  if (!(hysteresis.get() >= 0 && hysteresis.get() <= boundary.get())) {
    throw std::runtime_error("port 'hysteresis' must be from 0 to 'boundary'");
  }
  now.cart = drift_of(drift.get(), drift_length.get(), align_rate.get());
  now.arms_align = true;
  is_aligning_ = false;
}

bool HoldCart::is_off() const {
  const double limit = boundary.get() - (is_aligning_ ? hysteresis.get() : 0);
  return std::abs(scene().cart.error) > limit;
}

HoldCart::Status HoldCart::tick() {
  CartScene& now = scene();
  error.set(now.cart.error);
  if (std::abs(now.cart.error) > slip.get()) {
    now.arms_align = false;
    log(lockstep::LogLevel::Warning,
        "the cart slips away after " + std::to_string(now.traveled) + " m");
    return Status::Failure;
  }
  is_aligning_ = is_off();
  return Status::Running;
}

double HoldCart::progress() const {
  return is_off() ? 0 : 1;
}

CartScene& FollowPath::scene() const {
  CartScene& scene = context<World>().cart;
  scene.advance();
  return scene;
}

void FollowPath::start() {
  CartScene& now = scene();
  now.base = drift_of(drift.get(), drift_length.get(), steer_rate.get());
  now.speed = speed.get();
  now.traveled = 0;
  now.base_moves = true;
}

FollowPath::Status FollowPath::tick() {
  CartScene& now = scene();
  traveled.set(now.traveled);
  if (now.traveled < path.get()) return Status::Running;
  now.base_moves = false;
  return Status::Success;
}

double FollowPath::progress() const {
  return std::abs(scene().base.error) > boundary.get() ? 0 : 1;
}

}  // namespace r1sim
