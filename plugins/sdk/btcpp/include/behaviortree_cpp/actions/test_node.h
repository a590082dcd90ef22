// A leaf for tests that takes the place of another node: BehaviorTreeFactory::addSubstitutionRule.
#pragma once

#include <lockstep/duration.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "behaviortree_cpp/action_node.h"

namespace BT {

struct TestNodeConfig {
  NodeStatus return_status = NodeStatus::SUCCESS;
  // When the node has completed: with that result, and with any.
  std::string success_script;
  std::string failure_script;
  std::string post_script;
  // How long it runs before; 0: it completes in its first tick.
  std::chrono::milliseconds async_delay{0};
  // Its value is the result, in place of return_status.
  std::function<NodeStatus()> complete_func;
  // A script whose value is the result, in place of return_status. In a tree it is evaluated in
  // each tick of the node.
  std::string return_status_script;
};

class TestNode : public StatefulActionNode {
 public:
  TestNode(const std::string& name, const NodeConfig& config,
           std::shared_ptr<TestNodeConfig> test_config)
      : StatefulActionNode(name, lockstep_with_scripts(config, *test_config)),
        lockstep_test_(std::move(test_config)) {
    if (lockstep_test_->return_status == NodeStatus::IDLE) {
      throw RuntimeError("the TestNode '", name, "' cannot return IDLE");
    }
  }
  TestNode(const std::string& name, const NodeConfig& config, TestNodeConfig test_config)
      : TestNode(name, config, std::make_shared<TestNodeConfig>(std::move(test_config))) {}

  static PortsList providedPorts() { return {}; }

  // Where a tree writes what return_status_script gives.
  static constexpr const char* kLockstepPort = "lockstep_status";

 protected:
  NodeStatus onStart() override {
    if (lockstep_test_->async_delay.count() <= 0) return onCompleted();
    lockstep_end_ =
        std::chrono::steady_clock::now() + lockstep::bounded(lockstep_test_->async_delay);
    return NodeStatus::RUNNING;
  }
  NodeStatus onRunning() override {
    const bool is_over = std::chrono::steady_clock::now() >= lockstep_end_;
    return is_over ? onCompleted() : NodeStatus::RUNNING;
  }
  void onHalted() override {}

  NodeStatus onCompleted() {
    if (lockstep_test_->complete_func) return lockstep_test_->complete_func();
    if (lockstep_test_->return_status_script.empty()) return lockstep_test_->return_status;
    const NodeStatus status = lockstep_scripted();
    if (status == NodeStatus::IDLE) {
      throw RuntimeError("return_status_script of the TestNode '", name(),
                         "' gives IDLE; it must give another status");
    }
    return status;
  }

 private:
  // For a node that a program makes: in a tree they are attributes of it.
  static NodeConfig lockstep_with_scripts(NodeConfig config, const TestNodeConfig& test) {
    if (lockstep_detail::creating != nullptr) return config;
    const auto add = [&config](PostCond when, const std::string& script) {
      std::string& all = config.post_conditions[when];
      all = all.empty() ? script : StrCat(script, "; ", all);
      if (all.empty()) config.post_conditions.erase(when);
    };
    add(PostCond::ON_SUCCESS, test.success_script);
    add(PostCond::ON_FAILURE, test.failure_script);
    add(PostCond::ALWAYS, test.post_script);
    return config;
  }

  NodeStatus lockstep_scripted() const {
    const auto value = getInput<Any>(kLockstepPort);
    if (!value) {
      throw RuntimeError("return_status_script of the TestNode '", name(),
                         "' has no value: ", value.error());
    }
    int number = 0;
    if (value->isNumber()) {
      number = value->cast<int>();
    } else {
      const auto text = value->cast<std::string>();
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
      if (error != std::errc()) return convertFromString<NodeStatus>(text);
    }
    if (number < 0 || number > static_cast<int>(NodeStatus::SKIPPED)) {
      throw RuntimeError("return_status_script of the TestNode '", name(), "' gives ",
                         std::to_string(number), ", which is no status");
    }
    return static_cast<NodeStatus>(number);
  }

  std::shared_ptr<TestNodeConfig> lockstep_test_;
  std::chrono::steady_clock::time_point lockstep_end_;
};

}  // namespace BT
