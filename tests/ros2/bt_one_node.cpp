// A plugin with one node, by CreateRosNodePlugin.
#include "behaviortree_ros2/bt_topic_pub_node.hpp"
#include "behaviortree_ros2/plugins.hpp"
#include "std_msgs/msg/bool.hpp"

class One : public BT::RosTopicPubNode<std_msgs::msg::Bool> {
 public:
  using RosTopicPubNode::RosTopicPubNode;
  bool setMessage(std_msgs::msg::Bool& message) override {
    RCLCPP_DEBUG(logger(), "says true at %f", now().seconds());
    message.data = true;
    return true;
  }
};

CreateRosNodePlugin(One, "SayTrue");
