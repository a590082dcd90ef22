// Leaves that are about the robot itself: its battery and its voice.
#pragma once

#include "timer.hpp"
#include "world.hpp"

namespace fetch {

struct BatteryPorts : lockstep::Ports {
  Input<double> level{this, "level", "0.2", "0 is empty, 1 is full"};
};

class BatteryAbove : public lockstep::Condition<BatteryPorts> {
 public:
  bool check() override { return context<World>().battery > level.get(); }
};

struct ChargePorts : lockstep::Ports {
  Input<double> level{this, "level", "0.9", "up to here; 1 is full"};
  Input<double> rate{this,  "rate",     "0.1", "how much of a full battery per second",
                     "1/s", at_least(0)};
};

class Charge : public lockstep::Action<ChargePorts> {
 public:
  void start() override { from_ = context<World>().battery; }
  Status tick() override;
  double progress() const override;

 private:
  double from_ = 0;
};

struct SayPorts : lockstep::Ports {
  Input<std::string> text{this, "text", required, "what to say"};
  Input<double> rate{this, "rate", "15", "characters per second", "1/s"};
};

class Say : public lockstep::Action<SayPorts> {
 public:
  void start() override;
  Status tick() override;
  double progress() const override { return timer_.progress(); }

 private:
  Timer timer_;
};

}  // namespace fetch
