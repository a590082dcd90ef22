// The node with the action server run_tree, which runs one tree at a time.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include <diagnostic_msgs/msg/diagnostic_array.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_action/rclcpp_action.hpp>
#include "tree_run.hpp"

namespace lockstep_ros {

class TreeServer : public rclcpp::Node {
 public:
  TreeServer();
  ~TreeServer() override;

 private:
  using RunTree = action::RunTree;
  using GoalHandle = rclcpp_action::ServerGoalHandle<RunTree>;

  rclcpp_action::GoalResponse look_at(const RunTree::Goal& goal);
  void begin(std::shared_ptr<GoalHandle> handle);
  void run(const std::shared_ptr<GoalHandle>& handle);
  RunTree::Result run_tree(GoalHandle& handle);
  bool is_stopped(const GoalHandle& handle) const;
  double wait_for(double time, rclcpp::Time& last, double& passed, const GoalHandle& handle);
  void tell(GoalHandle& handle, msg::TreeState state);
  void end(const RunTree::Goal& goal, const RunTree::Result& result);
  void diagnose();
  TreeSettings settings();

  rclcpp_action::Server<RunTree>::SharedPtr server_;
  rclcpp::Publisher<msg::TreeState>::SharedPtr states_;
  rclcpp::Publisher<diagnostic_msgs::msg::DiagnosticArray>::SharedPtr diagnostics_;
  rclcpp::TimerBase::SharedPtr timer_;
  std::thread thread_;
  std::atomic<bool> is_busy_{false}, is_ending_{false};
  std::shared_ptr<lockstep::runtime::Project> last_project_;  // of the thread that runs
  std::mutex mutex_;
  msg::TreeState last_;    // guarded by mutex_
  RunTree::Result ended_;  // guarded by mutex_
};

}  // namespace lockstep_ros
