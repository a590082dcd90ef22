// The leaves of the hallway scene: a robot that seeks objects. Progress of head and base is the
// part of the hallway swept and driven. After the experiments on absolute and relative
// synchronization in the paper.
#pragma once

#include <lockstep/leaf.hpp>

#include "hallway.hpp"
#include "part_action.hpp"

namespace r1sim {

struct EnterHallwayPorts : lockstep::Ports {
  Input<double> length{this, "length", "10", "of the hallway", "m"};
  Input<std::int64_t> objects{this, "objects", "8", "how many lie in it, at random places",
                              between(0, 1000)};
  Input<double> identify_min{this, "identify_min", "1", "least time to identify one", "s"};
  Input<double> identify_max{this, "identify_max", "4", "most time to identify one", "s"};
};

class EnterHallway : public lockstep::Action<EnterHallwayPorts> {
 public:
  Status tick() override;
};

struct SwipePorts : lockstep::Ports {
  Input<double> speed{this, "speed", "0.5", "hallway swept per second", "m/s"};
  Input<double> stripe{this, "stripe", "0.25", "hallway per sweep from side to side", "m"};
  Input<double> reach{this, "reach", "1", "how far it sees from the middle of its view", "m"};
  Output<std::int64_t> identified{this, "identified", "objects identified so far"};
  Output<std::int64_t> missed{this, "missed", "objects missed so far"};
};

class Swipe : public PartAction<SwipePorts> {
 public:
  void start() override;
  Status tick() override;
  double progress() const override;

 private:
  bool& moves() const override { return scene().head.moves; }
  HallwayScene& scene() const;
  void tell(const HallwayScene& now);

  std::int64_t told_missed_ = 0;
};

struct NavigatePorts : lockstep::Ports {
  Input<double> speed{this, "speed", "0.25", "of the base", "m/s"};
};

class Navigate : public PartAction<NavigatePorts> {
 public:
  void start() override;
  Status tick() override;
  double progress() const override;

 private:
  bool& moves() const override { return scene().base.moves; }
  HallwayScene& scene() const;
};

struct MissedAtMostPorts : lockstep::Ports {
  Input<std::int64_t> count{this, "count", "0", "how many may be missed"};
};

class MissedAtMost : public lockstep::Condition<MissedAtMostPorts> {
 public:
  bool check() override;
};

}  // namespace r1sim
