// Waits for a reply that another thread brings, and is ticked when it is there.
#include <atomic>
#include <thread>

#include "behaviortree_cpp/bt_factory.h"

class Reply : public BT::StatefulActionNode {
 public:
  Reply(const std::string& name, const BT::NodeConfig& config) : StatefulActionNode(name, config) {}
  ~Reply() override {
    if (thread_.joinable()) thread_.join();
  }
  static BT::PortsList providedPorts() { return {}; }
  BT::NodeStatus onStart() override {
    thread_ = std::thread([this] {
      is_there_ = true;
      emitWakeUpSignal();
    });
    return BT::NodeStatus::RUNNING;
  }
  BT::NodeStatus onRunning() override {
    return is_there_ ? BT::NodeStatus::SUCCESS : BT::NodeStatus::RUNNING;
  }
  void onHalted() override {}

 private:
  std::atomic<bool> is_there_{false};
  std::thread thread_;
};

// Its tick() is in a thread of its own.
class Work : public BT::ThreadedAction {
 public:
  using ThreadedAction::ThreadedAction;
  static BT::PortsList providedPorts() { return {}; }
  BT::NodeStatus tick() override { return BT::NodeStatus::SUCCESS; }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Reply>("Reply");
  factory.registerNodeType<Work>("Work");
}
