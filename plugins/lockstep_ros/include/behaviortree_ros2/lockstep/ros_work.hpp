// The part of ROS that each node of a tree has for itself: its callbacks run in its own tick, and
// after a halt, for what is late, in a thread.
#pragma once

#include <behaviortree_cpp/bt_factory.h>

#include <atomic>
#include <rclcpp/rclcpp.hpp>
#include <sstream>
#include <thread>

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

  ~RosWork() { stop_thread(); }
  RosWork(const RosWork&) = delete;
  RosWork& operator=(const RosWork&) = delete;

  const std::shared_ptr<rclcpp::Node>& node() const { return node_; }
  const std::shared_ptr<rclcpp::CallbackGroup>& group() const { return group_; }
  const RosNodeParams& params() const { return params_; }

  // The callbacks of what has come. Returns at once; false: the thread has not ended yet.
  bool spin() {
    if (!has_stopped_thread()) return false;
    executor_->spin_some();
    return true;
  }
  // In a thread, until `is_done()` or the next spin.
  template <class Done>
  void spin_apart(Done is_done) {
    stop_thread();
    is_needed_ = has_ended_ = false;
    thread_ = std::thread([this, is_done] {
      while (!is_needed_ && !is_done()) executor_->spin_once(std::chrono::milliseconds(10));
      has_ended_ = true;
    });
  }
  template <class Done>
  void spin_until(Done is_done, Clock::duration most) {
    stop_thread();
    const auto end = Clock::now() + most;
    while (!is_done() && Clock::now() < end) executor_->spin_once(std::chrono::milliseconds(10));
  }

  void begin_wait(std::chrono::milliseconds most) {
    deadline_ = Clock::now() + ::lockstep::bounded(most);
  }
  bool has_waited_long() const { return Clock::now() >= deadline_; }

 private:
  void stop_thread() {
    is_needed_ = true;
    if (thread_.joinable()) thread_.join();
  }
  // Never waits.
  bool has_stopped_thread() {
    is_needed_ = true;
    if (thread_.joinable() && has_ended_) thread_.join();
    return !thread_.joinable();
  }
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
  std::thread thread_;
  std::atomic<bool> is_needed_{false}, has_ended_{false};
};

// The port with the name of an action, a service or a topic.
struct ActionName {
  static constexpr const char *kPort = "action_name", *kDoc = "The name of the action";
};
struct ServiceName {
  static constexpr const char *kPort = "service_name", *kDoc = "The name of the service";
};
struct TopicName {
  static constexpr const char *kPort = "topic_name", *kDoc = "The name of the topic";
};

// A node of a tree with its part of ROS, under the name that its port gives, or the default of the
// parameters.
template <class Base, class Name>
class RosNode : public Base {
 public:
  static PortsList providedBasicPorts(PortsList more) {
    PortsList all = {InputPort<std::string>(Name::kPort, "", Name::kDoc)};
    all.insert(more.begin(), more.end());
    return all;
  }
  static PortsList providedPorts() { return providedBasicPorts({}); }

 protected:
  RosNode(const std::string& name, const NodeConfig& config, const RosNodeParams& params)
      : Base(name, config), lockstep_work_(params) {}

  rclcpp::Logger logger() { return lockstep_work_.node()->get_logger(); }
  rclcpp::Time now() { return lockstep_work_.node()->now(); }

  // Whether the name is known before the first tick, which is not to wait for the making of a
  // client.
  bool lockstep_has_name() const { return !lockstep_find_name().empty(); }
  // True if it is another one than before.
  bool lockstep_takes_name() {
    std::string found = lockstep_find_name();
    if (found.empty()) {
      throw RuntimeError("the port '" + std::string(Name::kPort) +
                         "' is empty, and so is RosNodeParams::default_port_value");
    }
    if (found == lockstep_name_) return false;
    lockstep_name_ = std::move(found);
    return true;
  }

  // For the `reason()` of a node: why it has failed, or what it waits for.
  void lockstep_say(const char* before, const char* after = "") {
    lockstep_reason_ = before + ("'" + lockstep_name_) + "'" + after;
  }

  RosWork lockstep_work_;
  std::string lockstep_name_, lockstep_reason_;

 private:
  std::string lockstep_find_name() const {
    const auto given = this->template getInput<std::string>(Name::kPort);
    const bool is_given = given && !given.value().empty();
    return is_given ? given.value() : lockstep_work_.params().default_port_value;
  }
};

// A result as YAML, of any type: ": {error_code: 101, error_msg: too far}".
template <class T>
std::string text_of(const T* message) {
  std::ostringstream text;
  if (message == nullptr) return {};
  to_flow_style_yaml(*message, text);
  return ": " + text.str();
}

inline NodeStatus completed(NodeStatus status, const char* function) {
  if (status == NodeStatus::SUCCESS || status == NodeStatus::FAILURE) return status;
  throw LogicError(std::string(function) + " has to return SUCCESS or FAILURE");
}

}  // namespace BT::lockstep_detail
