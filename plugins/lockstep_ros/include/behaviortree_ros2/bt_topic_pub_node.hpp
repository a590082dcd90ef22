// Publishes a message of ROS 2 in each tick: derive from RosTopicPubNode<TopicT>, and write
// setMessage.
#pragma once

#include "behaviortree_ros2/lockstep/ros_work.hpp"

namespace BT {

template <class TopicT>
class RosTopicPubNode : public lockstep_detail::RosNode<ConditionNode, lockstep_detail::TopicName> {
 public:
  using Publisher = rclcpp::Publisher<TopicT>;

  RosTopicPubNode(const std::string& name, const NodeConfig& config, const RosNodeParams& params)
      : RosNode(name, config, params) {
    if (lockstep_has_name()) lockstep_open();
  }

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
    if (!lockstep_takes_name()) return;
    lockstep_publisher_ =
        lockstep_work_.node()->template create_publisher<TopicT>(lockstep_name_, 1);
  }

  typename Publisher::SharedPtr lockstep_publisher_;
};

}  // namespace BT
