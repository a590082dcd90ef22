// What nodes of a tree need of ROS: the node of rclcpp, and how long they wait.
#pragma once

#include <chrono>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <utility>

namespace BT {

struct RosNodeParams {
  std::weak_ptr<rclcpp::Node> nh;
  // The name of the action, service or topic where the tree gives none.
  std::string default_port_value;
  // For an answer: that a goal is accepted, and that of a service.
  std::chrono::milliseconds server_timeout{1000};
  // For a server that is not there.
  std::chrono::milliseconds wait_for_server_timeout{500};

  // For lockstep: makes the node when the first node of a tree needs it, where `nh` is none.
  std::shared_ptr<rclcpp::Node> (*lockstep_make_node)() = nullptr;

  RosNodeParams() = default;
  RosNodeParams(std::shared_ptr<rclcpp::Node> node) : nh(node) {}
  RosNodeParams(std::shared_ptr<rclcpp::Node> node, std::string port_value)
      : nh(node), default_port_value(std::move(port_value)) {}
};

}  // namespace BT
