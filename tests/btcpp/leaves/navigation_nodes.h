// Nodes as people write them for navigation: control nodes and decorators with their own counters,
// and actions over a base that talks to a server. What they share is a Robot, which stands for the
// node of a robotics framework: a clock, a pose, goals that come, and a log.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "behaviortree_cpp/bt_factory.h"

namespace navigation {

using BT::NodeStatus;

struct Robot {
  using Ptr = std::shared_ptr<Robot>;
  double seconds = 0, x = 0, speed = 0;
  int goal = 0;  // that has come last
  std::function<void(const std::string&)> log;
};

// Ticks again what has succeeded before, while a later child runs.
class PipelineSequence : public BT::ControlNode {
 public:
  PipelineSequence(const std::string& name, const BT::NodeConfiguration& config)
      : BT::ControlNode(name, config) {}
  static BT::PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    for (std::size_t i = 0; i < children_nodes_.size(); ++i) {
      switch (children_nodes_[i]->executeTick()) {
        case NodeStatus::FAILURE:
          ControlNode::halt();
          furthest_ = 0;
          return NodeStatus::FAILURE;
        case NodeStatus::RUNNING:
          if (i < furthest_) break;
          furthest_ = i;
          return NodeStatus::RUNNING;
        case NodeStatus::SUCCESS:
        case NodeStatus::SKIPPED:
          break;
        default:
          throw std::runtime_error("a child of '" + name() + "' is idle");
      }
    }
    ControlNode::halt();
    furthest_ = 0;
    return NodeStatus::SUCCESS;
  }
  void halt() override {
    ControlNode::halt();
    furthest_ = 0;
  }

 protected:
  std::size_t furthest_ = 0;
};

// Each child has its turn until one succeeds; the next activation begins with the one behind it.
class RoundRobin : public BT::ControlNode {
 public:
  explicit RoundRobin(const std::string& name) : BT::ControlNode(name, {}) {}
  RoundRobin(const std::string& name, const BT::NodeConfiguration& config)
      : BT::ControlNode(name, config) {}
  static BT::PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    const std::size_t count = childrenCount();
    setStatus(NodeStatus::RUNNING);
    while (failed_ < count) {
      BT::TreeNode* const child = children_nodes_[current_];
      const NodeStatus status = child->executeTick();
      if (status == NodeStatus::RUNNING) return NodeStatus::RUNNING;
      current_ = (current_ + 1) % count;
      if (status == NodeStatus::SUCCESS) {
        failed_ = 0;
        ControlNode::haltChildren();
        return NodeStatus::SUCCESS;
      }
      ++failed_;
    }
    halt();
    return NodeStatus::FAILURE;
  }
  void halt() override {
    ControlNode::halt();
    current_ = failed_ = 0;
  }

 private:
  std::size_t current_ = 0, failed_ = 0;
};

// The second child mends what let the first one fail; then the first one gets another try.
class RecoveryNode : public BT::ControlNode {
 public:
  RecoveryNode(const std::string& name, const BT::NodeConfiguration& config)
      : BT::ControlNode(name, config) {}
  static BT::PortsList providedPorts() {
    return {BT::InputPort<int>("number_of_retries", 1, "how often it is tried again")};
  }

 private:
  NodeStatus tick() override {
    if (childrenCount() != 2) throw BT::BehaviorTreeException("'", name(), "' has two children");
    getInput("number_of_retries", retries_);
    setStatus(NodeStatus::RUNNING);
    while (retry_ <= retries_) {
      BT::TreeNode* const child = children_nodes_[current_];
      const NodeStatus status = child->executeTick();
      if (status == NodeStatus::RUNNING) return status;
      if (current_ == 0 && status != NodeStatus::FAILURE) {
        halt();
        return status;
      }
      if (current_ == 0 && retry_ == retries_) break;
      if (current_ == 1 && status == NodeStatus::FAILURE) break;
      haltChild(current_);
      retry_ += current_ == 1 ? 1 : 0;
      current_ = 1 - current_;
    }
    halt();
    return NodeStatus::FAILURE;
  }
  void halt() override {
    ControlNode::halt();
    retry_ = 0;
    current_ = 0;
  }

  std::size_t current_ = 0;
  int retries_ = 1, retry_ = 0;
};

// A decorator that lets its child tick when it is due, and while it runs.
class Controller : public BT::DecoratorNode {
 public:
  Controller(const std::string& name, const BT::NodeConfiguration& config, Robot::Ptr robot)
      : BT::DecoratorNode(name, config), robot_(std::move(robot)) {}

 protected:
  virtual void begin() = 0;
  virtual bool is_due() = 0;
  NodeStatus tick() override {
    const bool is_first = !BT::isStatusActive(status());
    if (is_first) begin();
    setStatus(NodeStatus::RUNNING);
    if (!is_first && child()->status() != NodeStatus::RUNNING && !is_due()) {
      return NodeStatus::RUNNING;
    }
    const NodeStatus status = child_node_->executeTick();
    if (status == NodeStatus::SUCCESS) begin();
    return status == NodeStatus::SKIPPED ? NodeStatus::RUNNING : status;
  }

  Robot::Ptr robot_;
};

class RateController : public Controller {
 public:
  using Controller::Controller;
  static BT::PortsList providedPorts() { return {BT::InputPort<double>("hz", 10.0, "Rate")}; }

 private:
  void begin() override {
    getInput("hz", hz_);
    since_ = robot_->seconds;
  }
  bool is_due() override { return robot_->seconds - since_ >= 1.0 / hz_; }
  double hz_ = 10, since_ = 0;
};

class DistanceController : public Controller {
 public:
  using Controller::Controller;
  static BT::PortsList providedPorts() {
    return {BT::InputPort<double>("distance", 1.0, "Distance"),
            BT::InputPort<std::string>("global_frame", "map", "Frame")};
  }

 private:
  void begin() override {
    getInput("distance", distance_);
    from_ = robot_->x;
  }
  bool is_due() override { return std::fabs(robot_->x - from_) >= distance_; }
  double distance_ = 1, from_ = 0;
};

class SpeedController : public Controller {
 public:
  using Controller::Controller;
  static BT::PortsList providedPorts() {
    return {BT::InputPort<double>("min_rate", 0.5, "Lowest rate"),
            BT::InputPort<double>("max_rate", 4.0, "Highest rate"),
            BT::InputPort<double>("max_speed", 1.0, "Speed of the highest rate")};
  }

 private:
  void begin() override { since_ = robot_->seconds; }
  bool is_due() override {
    const double low = getInput<double>("min_rate").value();
    const double high = getInput<double>("max_rate").value();
    const double share = std::fabs(robot_->speed) / getInput<double>("max_speed").value();
    return robot_->seconds - since_ >= 1.0 / (low + (high - low) * std::min(share, 1.0));
  }
  double since_ = 0;
};

// Passes the newest goal on.
class GoalUpdater : public BT::DecoratorNode {
 public:
  GoalUpdater(const std::string& name, const BT::NodeConfiguration& config, Robot::Ptr robot)
      : BT::DecoratorNode(name, config), robot_(std::move(robot)) {}
  static BT::PortsList providedPorts() {
    return {BT::InputPort<int>("input_goal", "Original goal"),
            BT::OutputPort<int>("output_goal", "Received goal")};
  }

 private:
  NodeStatus tick() override {
    int goal = 0;
    getInput("input_goal", goal);
    setOutput("output_goal", std::max(goal, robot_->goal));
    return child_node_->executeTick();
  }
  Robot::Ptr robot_;
};

class GoalUpdated : public BT::ConditionNode {
 public:
  GoalUpdated(const std::string& name, const BT::NodeConfiguration& config, Robot::Ptr robot)
      : BT::ConditionNode(name, config), robot_(std::move(robot)) {}
  static BT::PortsList providedPorts() { return {}; }

 private:
  NodeStatus tick() override {
    const bool is_first = !BT::isStatusActive(status());
    const bool is_new = !is_first && goal_ != robot_->goal;
    goal_ = robot_->goal;
    robot_->log(name() + (is_new ? " new" : " same"));
    return is_new ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }
  Robot::Ptr robot_;
  int goal_ = 0;
};

// What a server does with a goal: a letter for each tick, R, S or F.
struct Server {
  std::string answers;
  std::size_t at = 0;
  NodeStatus ask() {
    const char letter = answers.empty() ? 'S' : answers[at++ % answers.size()];
    return letter == 'R'   ? NodeStatus::RUNNING
           : letter == 'F' ? NodeStatus::FAILURE
                           : NodeStatus::SUCCESS;
  }
};

// The base of actions that a server does. `Action` has the type of its goals.
template <class Action>
class ServerAction : public BT::ActionNodeBase {
 public:
  ServerAction(const std::string& name, std::string action, const BT::NodeConfiguration& config,
               Robot::Ptr robot)
      : BT::ActionNodeBase(name, config), robot_(std::move(robot)), action_(std::move(action)) {}
  ServerAction() = delete;
  static BT::PortsList providedBasicPorts(BT::PortsList addition) {
    BT::PortsList basic = {BT::InputPort<std::string>("server_name", "Action name"),
                           BT::InputPort<std::string>("answers", "S", "What the server does")};
    basic.insert(addition.begin(), addition.end());
    return basic;
  }
  static BT::PortsList providedPorts() { return providedBasicPorts({}); }

  virtual void on_tick() {}
  virtual void on_wait_for_result() {}
  virtual NodeStatus on_success() { return NodeStatus::SUCCESS; }
  virtual NodeStatus on_aborted() { return NodeStatus::FAILURE; }
  virtual NodeStatus on_cancelled() { return NodeStatus::SUCCESS; }

  NodeStatus tick() override {
    if (!BT::isStatusActive(status())) {
      setStatus(NodeStatus::RUNNING);
      is_sent_ = true;
      getInput("answers", server_.answers);
      on_tick();
      robot_->log(name() + " sends " + std::to_string(goal_) + " to " + action_);
    }
    const NodeStatus answer = server_.ask();
    if (answer == NodeStatus::RUNNING) {
      on_wait_for_result();
      robot_->log(name() + " waits");
      return answer;
    }
    is_sent_ = false;
    robot_->log(name() + (answer == NodeStatus::SUCCESS ? " has succeeded" : " was aborted"));
    return answer == NodeStatus::SUCCESS ? on_success() : on_aborted();
  }
  void halt() override {
    if (is_sent_ && status() == NodeStatus::RUNNING) {
      robot_->log(name() + " cancels");
      on_cancelled();
    }
    is_sent_ = false;
    resetStatus();
  }

 protected:
  Robot::Ptr robot_;
  const std::string action_;
  typename Action::Goal goal_{};
  bool is_sent_ = false;

 private:
  Server server_;
};

struct ComputePath {
  using Goal = int;
};
struct FollowPath {
  using Goal = double;
};

class ComputePathAction : public ServerAction<ComputePath> {
 public:
  using ServerAction::ServerAction;
  static BT::PortsList providedPorts() {
    return providedBasicPorts({BT::InputPort<int>("goal", "Where to"),
                               BT::OutputPort<std::vector<double>>("path", "The way")});
  }
  void on_tick() override { getInput("goal", goal_); }
  NodeStatus on_success() override {
    setOutput("path", std::vector<double>{robot_->x, double(goal_)});
    return NodeStatus::SUCCESS;
  }
  NodeStatus on_aborted() override {
    setOutput("path", std::vector<double>());
    return NodeStatus::FAILURE;
  }
};

class FollowPathAction : public ServerAction<FollowPath> {
 public:
  using ServerAction::ServerAction;
  static BT::PortsList providedPorts() {
    return providedBasicPorts({BT::InputPort<std::vector<double>>("path", "The way")});
  }
  void on_tick() override { take_path(); }
  void on_wait_for_result() override {
    robot_->speed = 0.4;
    take_path();
  }

 private:
  void take_path() {
    std::vector<double> path;
    const auto read = getInput("path", path);
    goal_ = read && !path.empty() ? path.back() : -1;
  }
};

inline void register_nodes(BT::BehaviorTreeFactory& factory, const Robot::Ptr& robot) {
  factory.registerNodeType<PipelineSequence>("PipelineSequence");
  factory.registerNodeType<RoundRobin>("RoundRobin");
  factory.registerNodeType<RecoveryNode>("RecoveryNode");
  const auto with_robot = [&](auto made, const std::string& id) {
    using Node = typename decltype(made)::type;
    factory.registerBuilder<Node>(
        id, [robot](const std::string& name, const BT::NodeConfiguration& config) {
          return std::make_unique<Node>(name, config, robot);
        });
  };
  const auto with_server = [&](auto made, const std::string& id, const std::string& action) {
    using Node = typename decltype(made)::type;
    BT::NodeBuilder builder = [robot, action](const std::string& name,
                                              const BT::NodeConfiguration& config) {
      return std::make_unique<Node>(name, action, config, robot);
    };
    factory.registerBuilder<Node>(id, builder);
  };
  with_robot(std::common_type<RateController>(), "RateController");
  with_robot(std::common_type<DistanceController>(), "DistanceController");
  with_robot(std::common_type<SpeedController>(), "SpeedController");
  with_robot(std::common_type<GoalUpdater>(), "GoalUpdater");
  with_robot(std::common_type<GoalUpdated>(), "GoalUpdated");
  with_server(std::common_type<ComputePathAction>(), "ComputePathToPose", "compute_path");
  with_server(std::common_type<FollowPathAction>(), "FollowPath", "follow_path");
}

}  // namespace navigation
