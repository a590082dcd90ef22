// One run of a tree for a goal of the server: the tree, its loop, and what is to be told of it.
#pragma once

#include <functional>
#include <lockstep/runtime.hpp>
#include <memory>
#include <string>
#include <vector>

#include <lockstep_ros/action/run_tree.hpp>

namespace lockstep_ros {

struct TreeSettings {
  std::string trees;  // the directory of trees without a leading '/'
  std::vector<std::string> plugin_path;
  double period = 0.01;
  double told_each = 0.1;  // seconds between two states
  std::function<void(const std::string& who, lockstep::LogLevel, const std::string&)> log;
};

class TreeRun {
 public:
  using Goal = action::RunTree::Goal;
  using Result = action::RunTree::Result;

  // Throws lockstep::runtime::Error with all errors of the tree.
  TreeRun(const Goal& goal, const TreeSettings& settings);

  // Whoever keeps it keeps the plugins as they are: the next tree that has them begins sooner.
  std::shared_ptr<lockstep::runtime::Project> project() const { return project_; }

  // Until the tree completes or `stop()`. `tell` gets the state after the first tick, then each
  // period of `told_each`, and after the last tick.
  Result loop(const std::function<bool()>& stop,
              const std::function<void(const msg::TreeState&)>& tell);
  // The same by another clock, which `wait` waits for: it returns the time at which the tick of
  // this time is to be, in seconds, or less than 0 to stop.
  Result loop(const std::function<double(double)>& wait,
              const std::function<void(const msg::TreeState&)>& tell);

 private:
  void observe(const std::function<void(const msg::TreeState&)>& tell);
  msg::TreeState state(std::uint64_t tick, double seconds, lockstep::Status status) const;
  Result result(bool is_stopped, lockstep::Status status) const;
  std::string holder_of(std::uint32_t held) const;
  std::string failed_leaf() const;

  const std::string name_;
  const TreeSettings settings_;
  const std::shared_ptr<lockstep::runtime::Project> project_;
  std::vector<lockstep::runtime::NodeInfo> nodes_;
  std::unique_ptr<lockstep::runtime::Run> run_;
  std::uint64_t ticks_ = 0;
  double seconds_ = 0, next_told_ = 0;
  std::string last_failure_;
};

}  // namespace lockstep_ros
