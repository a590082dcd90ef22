// The goals of one leaf, one at a time, at one action server.
#pragma once

#include <rcl_action/rcl_action.h>

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "middleware.hpp"
#include "triple_buffer.hpp"
#include "types.hpp"

namespace ros2 {

enum class Outcome : std::uint8_t {
  Open,
  Succeeded,
  Aborted,
  Canceled,
  Rejected,
  NoServer,
  ServerLost,
  Failed  // ROS itself has failed: a line says how
};

class ActionClient final : public Waitable {
 public:
  enum class State : std::uint8_t { Idle, WaitsForServer, IsSent, IsAccepted, IsHeld };

  ActionClient(const ActionType& type, std::string action);
  ~ActionClient() override;

  // By the leaf. Activations are numbered, from 1.
  struct Goal {
    std::uint64_t activation = 0;
    std::shared_ptr<Message> request = {};
    double server_timeout = 0;
  };
  struct Feedback {
    Message message;
    std::uint64_t activation = 0;
    unsigned sent = 0;  // how many times its goal had been sent
  };
  Outcome outcome(std::uint64_t activation) const;
  // How far the activation is. Idle: it waits for the end of the one before.
  State state(std::uint64_t activation) const;
  // Whether a goal up to this one may still be at work.
  bool is_busy(std::uint64_t activation) const { return ended_.load() >> 8 < activation; }
  TripleBuffer<Feedback>& feedback() { return feedback_; }
  // The result of the activation that has ended last.
  const Message& result() const { return *result_; }
  Lines& lines() { return lines_; }

  // By the thread of ROS.
  void open();
  void send(Goal goal);
  // Another goal of the same activation, which comes in the place of the one that is at work.
  void replace(Goal goal);
  void cancel(std::uint64_t activation);
  // At once, if it has ended already.
  void when_ended(std::uint64_t activation, std::function<void()> work);
  // The goal is canceled and kept, and sent again by resume.
  void hold(std::uint64_t activation);
  void resume(std::uint64_t activation);

  void add_sizes(Sizes& sizes) const override;
  void add_to(rcl_wait_set_t& set) override;
  void take(const rcl_wait_set_t& set) override;
  bool poll(Clock::time_point now) override;

 private:
  enum class Wish { None, Cancel, Hold };

  bool is_open(std::uint64_t activation) const {
    return state_ != State::Idle && goal_.activation == activation;
  }
  void set_state(State state);
  void begin(Goal goal);
  void send_again();
  void end(Outcome outcome);
  void run_what_waits();
  void drop(std::uint64_t activation);
  bool has_server();
  void poll_for_server(Clock::time_point now);
  void poll_goal(Clock::time_point now);
  void send_goal();
  void ask_for_result();
  void ask_to_cancel();
  bool send_cancel(const void* id, std::int64_t& call);
  void leave_unanswered();
  void take_late_answer(std::int64_t call, bool is_accepted);
  void reject();
  void take_goal_response();
  void take_result();
  void take_feedback();
  void take_cancel_response();
  void take_status();
  bool is_own(const Message& message) const;
  void fail(const std::string& what);

  static constexpr std::size_t kIdSize = 16;
  // A goal that was halted before the server has accepted it.
  struct Unanswered {
    std::int64_t call;
    std::array<unsigned char, kIdSize> id;
  };

  const ActionType& type_;
  const std::string action_;
  rcl_action_client_t client_;
  bool is_made_ = false;
  bool has_told_ = false;  // which other actions there are
  std::string why_not_made_;

  State state_ = State::Idle;
  Wish wish_ = Wish::None;
  bool is_canceling_ = false, is_resumed_ = false;
  Goal goal_;
  std::optional<Goal> next_;  // waits until the one before has ended
  std::vector<Unanswered> unanswered_;
  std::vector<std::pair<std::uint64_t, std::function<void()>>> when_ended_;
  std::shared_ptr<Message> replaced_;  // by the goal that the server has not accepted yet
  unsigned sent_ = 0;
  std::int64_t goal_call_ = 0, result_call_ = 0, cancel_call_ = 0;
  Clock::time_point deadline_, next_look_, cancel_until_;
  std::optional<Clock::time_point> server_since_;

  Message goal_response_, result_request_;
  std::unique_ptr<Message> result_, next_result_;
  TripleBuffer<Feedback> feedback_;
  std::atomic<std::uint64_t> ended_{0};  // the activation, and its outcome in the last 8 bits
  std::atomic<std::uint64_t> shown_{0};  // that of state_, and this in the last 8 bits
  Lines lines_;
};

}  // namespace ros2
