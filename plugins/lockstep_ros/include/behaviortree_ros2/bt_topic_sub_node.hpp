// Reads the newest message of a topic of ROS 2 in each tick: derive from RosTopicSubNode<TopicT>,
// and write onTick.
#pragma once

#include "behaviortree_ros2/lockstep/ros_work.hpp"

namespace BT {

template <class TopicT>
class RosTopicSubNode : public lockstep_detail::RosNode<ConditionNode, lockstep_detail::TopicName> {
 public:
  using Subscriber = rclcpp::Subscription<TopicT>;

  // Messages count from here on, where the name of the topic is known already.
  RosTopicSubNode(const std::string& name, const NodeConfig& config, const RosNodeParams& params)
      : RosNode(name, config, params) {
    if (lockstep_has_name()) lockstep_open();
  }

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
    if (!lockstep_takes_name()) return;
    lockstep_last_.reset();
    rclcpp::SubscriptionOptions options;
    options.callback_group = lockstep_work_.group();
    lockstep_subscriber_ = lockstep_work_.node()->template create_subscription<TopicT>(
        lockstep_name_, 1,
        [this](std::shared_ptr<TopicT> message) { lockstep_last_ = std::move(message); }, options);
  }

  typename Subscriber::SharedPtr lockstep_subscriber_;
  std::shared_ptr<TopicT> lockstep_last_;
};

}  // namespace BT
