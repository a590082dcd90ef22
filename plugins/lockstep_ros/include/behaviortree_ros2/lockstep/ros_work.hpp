// The part of ROS that each node of a tree has for itself: its callbacks run in its own tick.
#pragma once

#include <behaviortree_cpp/bt_factory.h>

#include <rclcpp/rclcpp.hpp>

#include "behaviortree_ros2/ros_node_params.hpp"

namespace BT::lockstep_detail {

class RosWork {
 public:
  using Clock = std::chrono::steady_clock;

  explicit RosWork(const RosNodeParams& params) : params_(params), node_(find_node(params)) {
    group_ = node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
    rclcpp::ExecutorOptions options;
    options.context = node_->get_node_base_interface()->get_context();
    executor_ = std::make_unique<rclcpp::executors::SingleThreadedExecutor>(options);
    executor_->add_callback_group(group_, node_->get_node_base_interface());
  }

  const std::shared_ptr<rclcpp::Node>& node() const { return node_; }
  const std::shared_ptr<rclcpp::CallbackGroup>& group() const { return group_; }
  const RosNodeParams& params() const { return params_; }

  // The callbacks of what has come. Returns at once.
  void spin() { executor_->spin_some(); }
  template <class Done>
  void spin_until(Done is_done, Clock::duration most) {
    const auto end = Clock::now() + most;
    while (!is_done() && Clock::now() < end) executor_->spin_once(std::chrono::milliseconds(10));
  }

  void begin_wait(std::chrono::milliseconds most) { deadline_ = Clock::now() + most; }
  bool has_waited_long() const { return Clock::now() >= deadline_; }

 private:
  static std::shared_ptr<rclcpp::Node> find_node(const RosNodeParams& params) {
    auto node = params.nh.lock();
    if (node == nullptr && params.lockstep_make_node != nullptr) node = params.lockstep_make_node();
    if (node == nullptr) throw RuntimeError("RosNodeParams::nh is no node of ROS, or it has ended");
    return node;
  }

  const RosNodeParams params_;
  std::shared_ptr<rclcpp::Node> node_;
  std::shared_ptr<rclcpp::CallbackGroup> group_;
  std::unique_ptr<rclcpp::executors::SingleThreadedExecutor> executor_;
  Clock::time_point deadline_;
};

// The name that a port of the tree gives, or the default of the parameters.
inline std::string ros_name(const TreeNode& node, const char* port, const RosNodeParams& params) {
  const auto given = node.getInput<std::string>(port);
  const std::string name = given ? given.value() : "";
  if (!name.empty()) return name;
  if (!params.default_port_value.empty()) return params.default_port_value;
  throw RuntimeError("the port '" + std::string(port) +
                     "' is empty, and so is "
                     "RosNodeParams::default_port_value");
}

// Whether it is known before the first tick, which is not to wait for the making of a client.
inline bool has_ros_name(const TreeNode& node, const char* port, const RosNodeParams& params) {
  const auto given = node.getInput<std::string>(port);
  return (given && !given.value().empty()) || !params.default_port_value.empty();
}

inline PortsList with_name_port(const char* port, const char* doc, PortsList more) {
  PortsList all = {InputPort<std::string>(port, "", doc)};
  all.insert(more.begin(), more.end());
  return all;
}

// A node of a tree with its part of ROS.
template <class Base>
class RosNode : public Base {
 protected:
  RosNode(const std::string& name, const NodeConfig& config, const RosNodeParams& params)
      : Base(name, config), lockstep_work_(params) {}

  rclcpp::Logger logger() { return lockstep_work_.node()->get_logger(); }
  rclcpp::Time now() { return lockstep_work_.node()->now(); }

  RosWork lockstep_work_;
  std::string lockstep_name_;  // of its action, service or topic
};

inline NodeStatus completed(NodeStatus status, const char* function) {
  if (status == NodeStatus::SUCCESS || status == NodeStatus::FAILURE) return status;
  throw LogicError(std::string(function) + " has to return SUCCESS or FAILURE");
}

}  // namespace BT::lockstep_detail
