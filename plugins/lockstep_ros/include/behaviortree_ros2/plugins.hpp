// CreateRosNodePlugin(Class, "ID"): a plugin with one node. With several, use BT_REGISTER_NODES and
// give each of them lockstep_ros_params().
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "behaviortree_ros2/lockstep/ros_work.hpp"

namespace BT {

// The node of a plugin, for as long as the process lives. LOCKSTEP_ROS_ARGS="-r __ns:=/left" is
// what
// --ros-args is for a program.
inline std::shared_ptr<rclcpp::Node> lockstep_ros_node() {
  static const auto node = [] {
    std::vector<std::string> words{"lockstep", "--ros-args"};
    const char* const given = std::getenv("LOCKSTEP_ROS_ARGS");
    std::istringstream text(given == nullptr ? "" : given);
    for (std::string word; text >> word;) words.push_back(word);
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());
    rclcpp::InitOptions options;
    options.auto_initialize_logging(false);
    const auto context = std::make_shared<rclcpp::Context>();
    context->init(static_cast<int>(arguments.size()), arguments.data(), options);
    return std::make_shared<rclcpp::Node>("lockstep_nodes_" + std::to_string(getpid()),
                                          rclcpp::NodeOptions().context(context));
  }();
  return node;
}

// Nothing of ROS is made before a tree runs: `lockstep check` loads plugins, too.
inline RosNodeParams lockstep_ros_params() {
  RosNodeParams params;
  params.lockstep_make_node = &lockstep_ros_node;
  return params;
}

}  // namespace BT

#define CreateRosNodePlugin(TYPE, REGISTRATION_NAME)                              \
  BT_REGISTER_NODES(factory) {                                                    \
    factory.registerNodeType<TYPE>(REGISTRATION_NAME, BT::lockstep_ros_params()); \
  }
