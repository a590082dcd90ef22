// The thread of a ThreadedAction.
#pragma once

#include <lockstep/cpp/threaded_action.hpp>

#include <atomic>
#include <utility>

#include "behaviortree_cpp/tree_node.h"

namespace BT::lockstep_detail {

class NodeThread {
 public:
  // The tree is ticked at once when the work is done.
  // `ended` is called in the thread when there is a result.
  template <class Work, class Ended>
  void launch(const TreeNode& node, Work work, Ended ended) {
    const Place* const place = node.lockstep_place_;
    const lockstep::detail::Caller caller =
        place != nullptr ? lockstep::detail::Caller{place->host, place->caller}
                         : lockstep::detail::Caller{&no_host()};
    status_ = NodeStatus::IDLE;
    worker_.launch(
        caller,
        [this, work, ended](lockstep::Token& token) {
          token_ = &token;
          status_ = work();
          ended();
          return lockstep::Status::Success;
        },
        [place] {
          if (place != nullptr) place->wake();
        });
  }
  bool is_done() const { return worker_.done(); }
  // Throws what the work has thrown.
  NodeStatus take() {
    worker_.take();
    return status_;
  }
  void stop() { worker_.stop_silently(); }
  // The result of the work that has ended last; IDLE: none has.
  NodeStatus result() const { return status_; }
  // In the thread.
  void yield() const {
    if (lockstep::detail::in_worker && token_ != nullptr) token_->yield();
  }

 private:
  // The host of a node outside of a tree: its thread works in real time.
  static const lockstep_host& no_host() {
    static const lockstep_host host = [] {
      lockstep_host none{};
      none.get_extension = [](const char*) -> const void* { return nullptr; };
      return none;
    }();
    return host;
  }

  lockstep::detail::Worker worker_;
  lockstep::Token* token_ = nullptr;  // the thread's
  std::atomic<NodeStatus> status_{NodeStatus::IDLE};
};

}  // namespace BT::lockstep_detail
