// A plugin of two leaves: an action that sweeps a joint to an angle, and a condition that looks at
// where the joint is. Rename, and put your robot in the place of the sum in tick().
#include <lockstep/leaf.hpp>

#include <cmath>
#include <stdexcept>

namespace {

struct SweepPorts : lockstep::Ports {
  Input<double> to{this, "to", required, "the angle to end at, not 0", "rad"};
  Input<double> speed{this, "speed", "0.5", "how fast the joint turns, above 0", "rad/s"};
  Output<double> angle{this, "angle", "where the joint is now", "rad"};
};

class Sweep : public lockstep::Action<SweepPorts> {
 public:
  void start() override {
    angle_ = 0;
    target_ = to.get();
    if (target_ == 0) throw std::runtime_error("port 'to' is 0: there is no way to go");
    if (!(speed.get() > 0)) throw std::runtime_error("port 'speed' is not above 0");
  }

  Status tick() override {
    const double left = std::abs(target_ - angle_);
    const double turn = speed.get() * tick_period();
    angle_ = turn >= left ? target_ : angle_ + std::copysign(turn, target_);
    angle.set(angle_);
    return angle_ == target_ ? Status::Success : Status::Running;
  }

  double progress() const override { return angle_ / target_; }

 private:
  double angle_ = 0;
  double target_ = 1;
};

struct IsBeyondPorts : lockstep::Ports {
  Input<double> angle{this, "angle", required, "the angle to look at", "rad"};
  Input<double> limit{this, "limit", "0", "true beyond this", "rad"};
};

class IsBeyond : public lockstep::Condition<IsBeyondPorts> {
 public:
  bool check() override { return angle.get() > limit.get(); }
};

}  // namespace

LOCKSTEP_PLUGIN("sweep", "0.1", "A joint that turns: where to start your own plugin",
                lockstep::leaf<Sweep>("Sweep", "Turns the joint until it is at an angle"),
                lockstep::leaf<IsBeyond>("IsBeyond", "Whether an angle is beyond a limit"));
