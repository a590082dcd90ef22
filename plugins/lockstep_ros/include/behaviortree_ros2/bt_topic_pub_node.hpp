// Publishes a message of ROS 2 in each tick: derive from RosTopicPubNode<TopicT>, and write
// setMessage.
#pragma once

#include "behaviortree_ros2/lockstep/ros_work.hpp"

namespace BT {

template <class TopicT>
class RosTopicPubNode : public lockstep_detail::RosNode<ConditionNode> {
 public:
  using Publisher = rclcpp::Publisher<TopicT>;

  RosTopicPubNode(const std::string& name, const NodeConfig& config, const RosNodeParams& params)
      : RosNode(name, config, params) {
    if (lockstep_detail::has_ros_name(*this, "topic_name", params)) lockstep_open();
  }

  static PortsList providedBasicPorts(PortsList more) {
    return lockstep_detail::with_name_port("topic_name", "The name of the topic", std::move(more));
  }
  static PortsList providedPorts() { return providedBasicPorts({}); }

  // False: nothing is published, and the node fails.
  virtual bool setMessage(TopicT& message) = 0;

  NodeStatus tick() override {
    lockstep_open();
    TopicT message;
    if (!setMessage(message)) return NodeStatus::FAILURE;
    lockstep_publisher_->publish(message);
    return NodeStatus::SUCCESS;
  }

 private:
  void lockstep_open() {
    const std::string name =
        lockstep_detail::ros_name(*this, "topic_name", lockstep_work_.params());
    if (name == lockstep_name_) return;
    lockstep_name_ = name;
    lockstep_publisher_ = lockstep_work_.node()->template create_publisher<TopicT>(name, 1);
  }

  typename Publisher::SharedPtr lockstep_publisher_;
};

}  // namespace BT
