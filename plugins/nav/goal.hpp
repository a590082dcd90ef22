// Nodes that look whether the goal of the navigation, or the path to it, is another one than
// before. A goal may be of any type. An object is another one when somebody has set it, also where
// it looks alike.
#pragma once

#include <lockstep/leaf.hpp>

#include "beginning.hpp"

namespace nav {

struct AnyGoalPorts : lockstep::Ports {
  Input<lockstep::Any> goal{this, "goal", "{goal}", "the goal of the navigation"};
  Input<lockstep::Any> goals{this, "goals", "{goals}", "the goals, where there are several"};

  // Whether one of them has changed since the last call.
  bool changed() const {
    const bool one = goal.changed(), several = goals.changed();
    return one || several;
  }
};

class GoalUpdated : public lockstep::Condition<AnyGoalPorts> {
 public:
  bool check() override;

 private:
  LastTick last_tick_;
};

class GlobalUpdatedGoal : public lockstep::Condition<AnyGoalPorts> {
 public:
  bool check() override;

 private:
  bool is_first_ = true;
};

class GoalUpdatedController : public Beginning<AnyGoalPorts> {
 public:
  Status tick() override;
};

struct PathTimerPorts : lockstep::Ports {
  Input<double> seconds{this, "seconds", "1", "how long a path is good", "s", at_least(0)};
  Input<lockstep::Any> path{this, "path", "{path}", "another path begins the time again"};
};

class PathExpiringTimer : public lockstep::Condition<PathTimerPorts> {
 public:
  bool check() override;

 private:
  bool is_first_ = true;
  double began_ = 0;
};

}  // namespace nav
