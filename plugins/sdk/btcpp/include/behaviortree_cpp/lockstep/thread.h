// The thread of a ThreadedAction.
#pragma once

#include <lockstep/cpp/threaded_action.hpp>

#include <utility>

#include "behaviortree_cpp/tree_node.h"

namespace BT::lockstep_detail {

class NodeThread {
 public:
  template <class Work>
  void launch(const TreeNode& node, Work work) {
    const Place& place = place_of(node);
    worker_.launch({place.host, place.caller}, [this, work](lockstep::Token& token) {
      token_ = &token;
      status_ = work();
      return lockstep::Status::Success;
    });
  }
  bool is_done() const { return worker_.done(); }
  // Throws what the work has thrown.
  NodeStatus take() {
    worker_.take();
    return status_;
  }
  void stop() { worker_.stop_silently(); }
  // In the thread.
  void yield() const {
    if (lockstep::detail::in_worker && token_ != nullptr) token_->yield();
  }

 private:
  static const Place& place_of(const TreeNode& node) { return *node.lockstep_place_; }

  lockstep::detail::Worker worker_;
  lockstep::Token* token_ = nullptr;  // the thread's
  NodeStatus status_ = NodeStatus::IDLE;
};

}  // namespace BT::lockstep_detail
