// An action of ROS 2 as a node: derive from RosActionNode<ActionT>, and write setGoal and
// onResultReceived. With lockstep a class may also have `double progress() const`, `void
// onPaused()` and `void onResumed()`; lockstep_hold() and lockstep_go_on() are for the latter two.
#pragma once

#include <map>
#include <optional>
#include <rclcpp_action/rclcpp_action.hpp>

#include "behaviortree_ros2/lockstep/ros_work.hpp"

namespace BT {

enum ActionNodeErrorCode {
  SERVER_UNREACHABLE,
  SEND_GOAL_TIMEOUT,
  GOAL_REJECTED_BY_SERVER,
  ACTION_ABORTED,
  ACTION_CANCELLED,
  INVALID_GOAL
};

inline const char* toStr(const ActionNodeErrorCode& code) {
  switch (code) {
    case SERVER_UNREACHABLE:
      return "SERVER_UNREACHABLE";
    case SEND_GOAL_TIMEOUT:
      return "SEND_GOAL_TIMEOUT";
    case GOAL_REJECTED_BY_SERVER:
      return "GOAL_REJECTED_BY_SERVER";
    case ACTION_ABORTED:
      return "ACTION_ABORTED";
    case ACTION_CANCELLED:
      return "ACTION_CANCELLED";
    case INVALID_GOAL:
      return "INVALID_GOAL";
  }
  return "";
}

template <class ActionT>
class RosActionNode : public lockstep_detail::RosNode<ActionNodeBase, lockstep_detail::ActionName> {
 public:
  using ActionType = ActionT;
  using ActionClient = rclcpp_action::Client<ActionT>;
  using ActionClientPtr = std::shared_ptr<ActionClient>;
  using Goal = typename ActionT::Goal;
  using GoalHandle = rclcpp_action::ClientGoalHandle<ActionT>;
  using WrappedResult = typename GoalHandle::WrappedResult;
  using Feedback = typename ActionT::Feedback;

  RosActionNode(const std::string& name, const NodeConfig& config, const RosNodeParams& params)
      : RosNode(name, config, params) {
    if (lockstep_has_name()) lockstep_open();
  }
  // A goal that was halted before the server has accepted it is canceled then.
  ~RosActionNode() override {
    lockstep_work_.spin_until([this] { return lockstep_unanswered_ == 0; },
                              std::chrono::seconds(1));
  }

  // False: the node fails with INVALID_GOAL.
  virtual bool setGoal(Goal& goal) = 0;
  virtual NodeStatus onResultReceived(const WrappedResult& result) = 0;
  // Anything but RUNNING cancels the goal, and is the result.
  virtual NodeStatus onFeedback(const std::shared_ptr<const Feedback> /*feedback*/) {
    return NodeStatus::RUNNING;
  }
  virtual NodeStatus onFailure(ActionNodeErrorCode /*code*/) { return NodeStatus::FAILURE; }
  virtual void onHalt() {}

  // For lockstep: why it has failed, or what it waits for. A class may have its own.
  const std::string& reason() const { return lockstep_reason_; }

  void cancelGoal() {
    if (lockstep_handle_ != nullptr && !lockstep_result_) lockstep_cancel(lockstep_handle_);
  }
  void halt() override {
    if (status() == NodeStatus::RUNNING) {
      cancelGoal();
      lockstep_end();
      onHalt();
    }
    resetStatus();
  }
  NodeStatus tick() override {
    if (!lockstep_work_.spin()) return NodeStatus::RUNNING;
    if (lockstep_phase_ == Phase::Idle) {
      Goal goal;
      lockstep_open();
      if (!setGoal(goal)) return lockstep_failed(INVALID_GOAL);
      lockstep_goal_ = std::move(goal);
      lockstep_begin();
    }
    return lockstep_advance();
  }

 protected:
  std::string getActionName() const { return lockstep_name_; }

  // For onPaused: the goal is canceled and kept. For onResumed: it is sent again.
  void lockstep_hold() {
    if (!lockstep_work_.spin() || lockstep_phase_ == Phase::Idle || lockstep_result_) return;
    cancelGoal();
    lockstep_forget_goal();
    lockstep_phase_ = Phase::IsHeld;
  }
  void lockstep_go_on() {
    if (lockstep_phase_ == Phase::IsHeld) lockstep_begin();
  }

 private:
  enum class Phase { Idle, WaitsForServer, IsSent, IsAccepted, IsHeld };
  using Handle = typename GoalHandle::SharedPtr;

  void lockstep_open() {
    if (!lockstep_takes_name()) return;
    lockstep_client_ = rclcpp_action::create_client<ActionT>(lockstep_work_.node(), lockstep_name_,
                                                             lockstep_work_.group());
  }

  void lockstep_begin() {
    lockstep_phase_ = Phase::WaitsForServer;
    lockstep_say("waits for the server of ");
    lockstep_work_.begin_wait(lockstep_work_.params().wait_for_server_timeout);
  }

  NodeStatus lockstep_advance() {
    if (lockstep_early_ != NodeStatus::RUNNING) {
      cancelGoal();
      const NodeStatus status = lockstep_early_;
      lockstep_end();
      return status;
    }
    if (lockstep_phase_ == Phase::WaitsForServer) return lockstep_look_for_server();
    if (lockstep_phase_ == Phase::IsSent && lockstep_work_.has_waited_long()) {
      return lockstep_failed(SEND_GOAL_TIMEOUT);
    }
    if (lockstep_is_rejected_) return lockstep_failed(GOAL_REJECTED_BY_SERVER);
    return lockstep_result_ ? lockstep_take_result() : NodeStatus::RUNNING;
  }

  NodeStatus lockstep_look_for_server() {
    if (lockstep_client_->action_server_is_ready()) {
      lockstep_send();
    } else if (lockstep_work_.has_waited_long()) {
      return lockstep_failed(SERVER_UNREACHABLE);
    }
    return NodeStatus::RUNNING;
  }

  // What belongs to a goal that was halted or sent again is late, and is not looked at.
  void lockstep_send() {
    const unsigned sent = ++lockstep_sent_;
    typename ActionClient::SendGoalOptions options;
    options.goal_response_callback = [this, sent](Handle handle) {
      --lockstep_unanswered_;
      if (sent != lockstep_sent_) {
        if (handle != nullptr) lockstep_cancel(handle);
        return;
      }
      lockstep_is_rejected_ = handle == nullptr;
      lockstep_handle_ = std::move(handle);
      lockstep_phase_ = Phase::IsAccepted;
      lockstep_say("the server of ", " has accepted the goal");
    };
    options.feedback_callback = [this, sent](Handle, std::shared_ptr<const Feedback> feedback) {
      if (sent == lockstep_sent_ && lockstep_early_ == NodeStatus::RUNNING) {
        lockstep_early_ = onFeedback(feedback);
      }
    };
    options.result_callback = [this, sent](const WrappedResult& result) {
      if (sent == lockstep_sent_) lockstep_result_ = result;
    };
    lockstep_phase_ = Phase::IsSent;
    lockstep_say("waits for the server of ", " to accept the goal");
    lockstep_work_.begin_wait(lockstep_work_.params().server_timeout);
    ++lockstep_unanswered_;
    lockstep_client_->async_send_goal(lockstep_goal_, options);
  }

  void lockstep_cancel(const Handle& handle) {
    try {
      lockstep_client_->async_cancel_goal(handle);
    } catch (const rclcpp_action::exceptions::UnknownGoalHandleError&) {
      // It has ended meanwhile.
    }
  }

  NodeStatus lockstep_take_result() {
    const WrappedResult result = *lockstep_result_;
    if (result.code == rclcpp_action::ResultCode::ABORTED) {
      return lockstep_failed(ACTION_ABORTED, result.result.get());
    }
    if (result.code == rclcpp_action::ResultCode::CANCELED) {
      return lockstep_failed(ACTION_CANCELLED, result.result.get());
    }
    lockstep_end();
    lockstep_reason_.clear();
    return lockstep_detail::completed(onResultReceived(result), "onResultReceived");
  }

  NodeStatus lockstep_failed(ActionNodeErrorCode code,
                             const typename ActionT::Result* result = nullptr) {
    lockstep_end();
    lockstep_say("the action ", ": ");
    lockstep_reason_ += toStr(code) + lockstep_detail::text_of(result);
    return lockstep_detail::completed(onFailure(code), "onFailure");
  }

  void lockstep_end() {
    lockstep_forget_goal();
    lockstep_phase_ = Phase::Idle;
    lockstep_early_ = NodeStatus::RUNNING;
    lockstep_is_rejected_ = false;
    lockstep_result_.reset();
  }

  // If the server accepts it later, it is canceled then, also if no tick comes.
  void lockstep_forget_goal() {
    ++lockstep_sent_;
    lockstep_handle_.reset();
    if (lockstep_unanswered_ == 0) return;
    lockstep_work_.spin_apart([this] { return lockstep_unanswered_ == 0; });
  }

  ActionClientPtr lockstep_client_;
  Goal lockstep_goal_;
  Phase lockstep_phase_ = Phase::Idle;
  Handle lockstep_handle_;
  std::optional<WrappedResult> lockstep_result_;
  NodeStatus lockstep_early_ = NodeStatus::RUNNING;  // of onFeedback
  bool lockstep_is_rejected_ = false;
  unsigned lockstep_sent_ = 0, lockstep_unanswered_ = 0;
};

}  // namespace BT
