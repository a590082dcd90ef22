// Nodes in the style of BehaviorTree.ROS2, one of each base class, as a user writes them.
#include "behaviortree_ros2/bt_action_node.hpp"
#include "behaviortree_ros2/bt_service_node.hpp"
#include "behaviortree_ros2/bt_topic_pub_node.hpp"
#include "behaviortree_ros2/bt_topic_sub_node.hpp"
#include "behaviortree_ros2/plugins.hpp"
#include "example_interfaces/action/fibonacci.hpp"
#include "example_interfaces/srv/set_bool.hpp"
#include "std_msgs/msg/bool.hpp"

namespace {

using example_interfaces::action::Fibonacci;
using example_interfaces::srv::SetBool;

class Count : public BT::RosActionNode<Fibonacci> {
 public:
  using RosActionNode::RosActionNode;
  static BT::PortsList providedPorts() {
    return providedBasicPorts({BT::InputPort<int>("order"), BT::InputPort<int>("stop_at", 0, ""),
                               BT::OutputPort<std::string>("why")});
  }
  bool setGoal(Goal& goal) override {
    goal.order = order_ = getInput<int>("order").value();
    done_ = 0;
    return order_ >= 0;
  }
  BT::NodeStatus onFeedback(const std::shared_ptr<const Feedback> feedback) override {
    done_ = int(feedback->sequence.size());
    const int stop_at = getInput<int>("stop_at").value();
    return stop_at != 0 && done_ >= stop_at ? BT::NodeStatus::SUCCESS : BT::NodeStatus::RUNNING;
  }
  BT::NodeStatus onResultReceived(const WrappedResult& result) override {
    const bool is_whole = int(result.result->sequence.size()) == order_;
    return is_whole ? BT::NodeStatus::SUCCESS : BT::NodeStatus::FAILURE;
  }
  BT::NodeStatus onFailure(BT::ActionNodeErrorCode code) override {
    setOutput("why", std::string(BT::toStr(code)));
    return BT::NodeStatus::FAILURE;
  }

  double progress() const { return order_ == 0 ? 0 : double(done_) / order_; }
  void onPaused() { lockstep_hold(); }
  void onResumed() { lockstep_go_on(); }

 private:
  int order_ = 0, done_ = 0;
};

class Hold : public BT::RosServiceNode<SetBool> {
 public:
  using RosServiceNode::RosServiceNode;
  static BT::PortsList providedPorts() {
    return providedBasicPorts({BT::InputPort<bool>("held"), BT::OutputPort<std::string>("why")});
  }
  bool setRequest(Request::SharedPtr& request) override {
    request->data = getInput<bool>("held").value();
    return true;
  }
  BT::NodeStatus onResponseReceived(const Response::SharedPtr& response) override {
    return response->success ? BT::NodeStatus::SUCCESS : BT::NodeStatus::FAILURE;
  }
  BT::NodeStatus onFailure(BT::ServiceNodeErrorCode code) override {
    setOutput("why", std::string(BT::toStr(code)));
    return BT::NodeStatus::FAILURE;
  }
};

class Say : public BT::RosTopicPubNode<std_msgs::msg::Bool> {
 public:
  using RosTopicPubNode::RosTopicPubNode;
  static BT::PortsList providedPorts() { return providedBasicPorts({BT::InputPort<bool>("data")}); }
  bool setMessage(std_msgs::msg::Bool& message) override {
    message.data = getInput<bool>("data").value();
    return true;
  }
};

class Hear : public BT::RosTopicSubNode<std_msgs::msg::Bool> {
 public:
  using RosTopicSubNode::RosTopicSubNode;
  BT::NodeStatus onTick(const std::shared_ptr<std_msgs::msg::Bool>& last_msg) override {
    return last_msg != nullptr && last_msg->data ? BT::NodeStatus::SUCCESS
                                                 : BT::NodeStatus::FAILURE;
  }
};

}  // namespace

BT_REGISTER_NODES(factory) {
  const BT::RosNodeParams params = BT::lockstep_ros_params();
  factory.registerNodeType<Count>("Count", params);
  factory.registerNodeType<Hold>("Hold", params);
  factory.registerNodeType<Say>("Say", params);
  factory.registerNodeType<Hear>("Hear", params);
}
