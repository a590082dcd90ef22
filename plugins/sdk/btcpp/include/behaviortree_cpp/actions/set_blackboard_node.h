// As the tag SetBlackboard.
#pragma once

#include <string>

#include "behaviortree_cpp/action_node.h"
#include "behaviortree_cpp/lockstep/parameter.h"

namespace BT {

class SetBlackboardNode : public SyncActionNode {
 public:
  using LockstepOpens = void;  // uses entries by their names
  SetBlackboardNode(const std::string& name, const NodeConfig& config)
      : SyncActionNode(name, config) {
    setRegistrationID("SetBlackboard");
  }
  static PortsList providedPorts() {
    return {InputPort("value", "what is written: a text, or {entry}"),
            BidirectionalPort("output_key",
                              "the name of the entry that is written; {entry}: its "
                              "value is the name")};
  }

 protected:
  NodeStatus tick() override {
    const auto target = lockstep_detail::parameter<std::string>(*this, "output_key");
    if (config().blackboard == nullptr) throw RuntimeError("the node has no blackboard");
    Blackboard& board = *config().blackboard;
    const std::string given(getRawPortValue("value"));
    StringView key;
    Any value;
    if (isBlackboardPointer(given, &key)) {
      const auto source = board.lockstep_find(std::string(key)).entry;
      if (source == nullptr) throw RuntimeError("there is no entry '" + std::string(key) + "'");
      value = source->value;
    } else {
      value = Any(given);
    }
    if (value.empty()) return NodeStatus::FAILURE;
    const auto before = board.lockstep_find(target).entry;
    board.lockstep_set(target, lockstep_as_in(before.get(), std::move(value)),
                       TypeInfo::Create<Any>());
    return NodeStatus::SUCCESS;
  }

 private:
  // A text becomes a value of the type that the entry has.
  static Any lockstep_as_in(const Blackboard::Entry* entry, Any value) {
    if (entry == nullptr || !value.isString() || !entry->info.isStronglyTyped() ||
        entry->info.type() == typeid(std::string)) {
      return value;
    }
    try {
      const Any converted = entry->info.parseString(value.cast<std::string>());
      return converted.empty() ? value : converted;
    } catch (const std::exception& error) {
      throw LogicError(std::string("SetBlackboard: ") + error.what());
    }
  }
};

}  // namespace BT
