// Reads the newest message of a topic of ROS 2 in each tick: derive from RosTopicSubNode<TopicT>,
// and write onTick.
#pragma once

#include "behaviortree_ros2/lockstep/ros_work.hpp"

namespace BT {

template <class TopicT>
class RosTopicSubNode : public lockstep_detail::RosNode<ConditionNode> {
 public:
  using Subscriber = rclcpp::Subscription<TopicT>;

  // Messages count from here on, where the name of the topic is known already.
  RosTopicSubNode(const std::string& name, const NodeConfig& config, const RosNodeParams& params)
      : RosNode(name, config, params) {
    if (lockstep_detail::has_ros_name(*this, "topic_name", params)) lockstep_open();
  }

  static PortsList providedBasicPorts(PortsList more) {
    return lockstep_detail::with_name_port("topic_name", "The name of the topic", std::move(more));
  }
  static PortsList providedPorts() { return providedBasicPorts({}); }

  // Null: none has come since the last tick.
  virtual NodeStatus onTick(const std::shared_ptr<TopicT>& last_msg) = 0;
  // True: a message is given to each tick until a newer one comes.
  virtual bool latchLastMessage() const { return false; }

  NodeStatus tick() override {
    lockstep_open();
    lockstep_work_.spin();
    const NodeStatus status = onTick(lockstep_last_);
    if (!latchLastMessage()) lockstep_last_.reset();
    return status;
  }

 private:
  void lockstep_open() {
    const std::string name =
        lockstep_detail::ros_name(*this, "topic_name", lockstep_work_.params());
    if (name == lockstep_name_) return;
    lockstep_name_ = name;
    lockstep_last_.reset();
    rclcpp::SubscriptionOptions options;
    options.callback_group = lockstep_work_.group();
    lockstep_subscriber_ = lockstep_work_.node()->template create_subscription<TopicT>(
        name, 1, [this](std::shared_ptr<TopicT> message) { lockstep_last_ = std::move(message); },
        options);
  }

  typename Subscriber::SharedPtr lockstep_subscriber_;
  std::shared_ptr<TopicT> lockstep_last_;
};

}  // namespace BT
