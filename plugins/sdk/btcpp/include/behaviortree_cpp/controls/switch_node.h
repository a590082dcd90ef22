// As the tags Switch2 to Switch6, with any number of cases.
#pragma once

#include <charconv>
#include <cmath>
#include <string>

#include "behaviortree_cpp/control_node.h"

namespace BT {
namespace lockstep_detail {

// False: the text is not all of a number.
template <class Number>
bool is_number(StringView text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace lockstep_detail

namespace details {

// Also where the texts are the same whole number, which may be written as a word of an enum, or
// nearly the same real one.
inline bool CheckStringEquality(const std::string& one, const std::string& other,
                                const ScriptingEnumsRegistry* words) {
  if (one == other) return true;
  const auto whole = [words](const std::string& text, int& number) {
    if (lockstep_detail::is_number(text, number)) return true;
    if (words == nullptr) return false;
    const auto word = words->find(text);
    if (word == words->end()) return false;
    number = word->second;
    return true;
  };
  int a = 0, b = 0;
  if (whole(one, a) && whole(other, b) && a == b) return true;
  double x = 0, y = 0;
  return lockstep_detail::is_number(one, x) && lockstep_detail::is_number(other, y) &&
         std::fabs(x - y) < 1.2e-7;
}

}  // namespace details

// Ticks the child of the first case that equals the variable, else the last one.
template <std::size_t NUM_CASES>
class SwitchNode : public ControlNode {
 public:
  SwitchNode(const std::string& name, const NodeConfig& config) : ControlNode(name, config) {
    setRegistrationID("Switch" + std::to_string(NUM_CASES));
  }
  static PortsList providedPorts() {
    PortsList ports{InputPort<std::string>("variable")};
    for (std::size_t i = 0; i < NUM_CASES; ++i) {
      ports.insert(InputPort<std::string>(lockstep_case(i)));
    }
    return ports;
  }

  void halt() override {
    lockstep_running_ = kLockstepNone;
    ControlNode::halt();
  }

 protected:
  NodeStatus tick() override {
    if (childrenCount() != NUM_CASES + 1) {
      lockstep_refuse_children(": it has one for each of " + std::to_string(NUM_CASES) +
                               " cases, and one more");
    }
    if (status() != NodeStatus::RUNNING) lockstep_running_ = kLockstepNone;
    const std::size_t chosen = lockstep_choose();
    if (lockstep_running_ != kLockstepNone && lockstep_running_ != chosen) {
      haltChild(lockstep_running_);
    }
    const NodeStatus result = children_nodes_[chosen]->executeTick();
    lockstep_running_ = result == NodeStatus::RUNNING ? chosen : kLockstepNone;
    if (isStatusCompleted(result)) resetChildren();
    return result;
  }

 private:
  static constexpr std::size_t kLockstepNone = SIZE_MAX;
  static std::string lockstep_case(std::size_t index) {
    return "case_" + std::to_string(index + 1);
  }
  std::size_t lockstep_choose() const {
    const auto variable = getInput<std::string>("variable");
    for (std::size_t i = 0; variable && i < NUM_CASES; ++i) {
      const auto value = getInput<std::string>(lockstep_case(i));
      if (value && details::CheckStringEquality(*variable, *value, config().enums.get())) return i;
    }
    return NUM_CASES;
  }

  std::size_t lockstep_running_ = kLockstepNone;
};

}  // namespace BT
