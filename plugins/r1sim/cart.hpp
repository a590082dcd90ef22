// The cart scene: the robot pushes a cart along a straight path. While the base moves, the cart
// drifts sideways in the robot's compliant hands; the arms bring it back, but slowly. After the
// example "Perpetual Actions" and the experiment of that name in the paper.
#pragma once

#include <lockstep/leaf.hpp>

#include "part_action.hpp"

namespace r1sim {

// A sideways error that grows as something rolls: its wheels point off course by a slope that
// changes at random and is forgotten over a length. Slope: m sideways per m forward.
struct Drift {
  double rms_slope = 0;
  double length = 1;           // m
  double correction_rate = 0;  // m/s
  double slope = 0;
  double error = 0;  // m

  void roll(double distance, lockstep::Run& run);
  void correct(double seconds);
};

class CartScene {
 public:
  explicit CartScene(lockstep::Run& run) : run_(run) {}

  // Brings the scene up to now; every leaf calls it first, so that it does not matter which one
  // does so first in a tick, nor how often a tick comes.
  void advance();

  Drift cart;           // against the robot's hands
  Drift base;           // against the path
  double speed = 0;     // m/s
  double traveled = 0;  // m
  bool arms_align = false;
  bool base_moves = false;

 private:
  lockstep::Run& run_;
  double time_ = 0;
};

struct HoldCartPorts : lockstep::Ports {
  Input<double> boundary{this, "boundary", "0.04", "progress is 0 above this error", "m"};
  Input<double> hysteresis{this, "hysteresis", "0",
                           "once it was 0, progress is 1 again this far within the boundary", "m"};
  Input<double> slip{this, "slip", "0.08", "the cart is lost at this error", "m"};
  Input<double> align_rate{this, "align_rate", "0.04", "how fast the arms bring it back", "m/s"};
  Input<double> drift{this, "drift", "0.15", "rms of the cart's slope: m sideways per m", "m/m"};
  Input<double> drift_length{this, "drift_length", "0.5", "length over which it changes", "m"};
  Output<double> error{this, "error", "how far the cart is off, to the left", "m"};
};

class HoldCart : public PartAction<HoldCartPorts> {
 public:
  void start() override;
  Status tick() override;
  double progress() const override;

 private:
  bool& moves() const override { return scene().arms_align; }
  CartScene& scene() const;
  bool is_off() const;

  bool is_aligning_ = false;  // beyond the boundary, and not far enough within it yet
};

struct FollowPathPorts : lockstep::Ports {
  Input<double> path{this, "path", "10", "length of the path", "m"};
  Input<double> speed{this, "speed", "0.5", "speed along it", "m/s"};
  Input<double> boundary{this, "boundary", "0.1", "progress is 0 above this error", "m"};
  Input<double> steer_rate{this, "steer_rate", "0.05", "how fast steering reduces it", "m/s"};
  Input<double> drift{this, "drift", "0.05", "rms of the base's slope: m sideways per m", "m/m"};
  Input<double> drift_length{this, "drift_length", "0.5", "length over which it changes", "m"};
  Output<double> traveled{this, "traveled", "how far the base has come", "m"};
};

class FollowPath : public PartAction<FollowPathPorts> {
 public:
  void start() override;
  Status tick() override;
  double progress() const override;

 private:
  bool& moves() const override { return scene().base_moves; }
  CartScene& scene() const;
};

}  // namespace r1sim
