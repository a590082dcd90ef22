// The manipulation scene: a task of changing pace, now fast, now slow, and nobody knows when. After
// the experiment on predictability in the paper.
#pragma once

#include <lockstep/leaf.hpp>

namespace r1sim {

struct DoTaskPorts : lockstep::Ports {
  Input<double> min_speed{this, "min_speed", "0.05", "slowest pace, in parts of the task", "1/s"};
  Input<double> max_speed{this, "max_speed", "1", "fastest pace", "1/s"};
  Input<double> change_time{this, "change_time",  "0.3", "mean time for which a pace lasts",
                            "s",  at_least(0.001)};
};

class DoTask : public lockstep::Action<DoTaskPorts> {
 public:
  void start() override;
  Status tick() override;
  double progress() const override { return progress_; }

 private:
  double progress_ = 0;
  double speed_ = 0;         // 1/s
  double until_change_ = 0;  // s of work
};

}  // namespace r1sim
