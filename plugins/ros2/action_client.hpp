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
  Unknown,  // after a cut: the server does not know the goal that was sent before it
  Failed    // ROS itself has failed: a line says how
};

constexpr std::size_t kIdSize = 16;
using GoalId = std::array<unsigned char, kIdSize>;
// An id that no other activation has.
GoalId new_goal_id();

class ActionClient final : public Waitable {
 public:
  enum class State : std::uint8_t { Idle, WaitsForServer, IsSent, IsAccepted, IsHeld, IsAsked };
  // How far the goal of an activation is. Each time that it is sent, it has another number.
  enum class Stage : std::uint8_t { Unsent, Sent, Accepted };
  struct Sent {
    std::uint32_t number = 1;  // of the goal that is at work, or comes next
    Stage stage = Stage::Unsent;
  };

  ActionClient(const ActionType& type, std::string action);
  ~ActionClient() override;

  // By the leaf. Activations are numbered, from 1.
  struct Goal {
    std::uint64_t activation = 0;
    std::shared_ptr<Message> request = {};
    double server_timeout = 0;
    GoalId id = {};  // that of the goals that are sent, but for their numbers
  };
  struct Feedback {
    Message message;
    std::uint64_t activation = 0;
    std::uint32_t number = 0;  // of the goal
  };
  Outcome outcome(std::uint64_t activation) const;
  // How far the activation is. Idle: it waits for the end of the one before.
  State state(std::uint64_t activation) const;
  Sent sent(std::uint64_t activation) const;
  // Whether a goal up to this one may still be at work.
  bool is_busy(std::uint64_t activation) const { return ended_.load() >> 8 < activation; }
  TripleBuffer<Feedback>& feedback() { return feedback_; }
  // The result of the activation that has ended last.
  const Message& result() const { return *result_; }
  Lines& lines() { return lines_; }

  // By the thread of ROS.
  void open();
  void send(Goal goal);
  // A goal that another process had sent before a cut, or was about to: the server is asked what
  // became of it. `is_held`: it was on hold, and is not to be at work.
  void take_up(Goal goal, Sent sent, bool is_held);
  // Another goal of the same activation, which comes in the place of the one that is at work.
  void replace(Goal goal);
  void cancel(std::uint64_t activation);
  // At once, if it has ended already.
  void when_ended(std::uint64_t activation, std::function<void()> work);
  // The goal is canceled and kept, and sent again by resume.
  void hold(std::uint64_t activation);
  void resume(std::uint64_t activation);
  // Until it returns true, from now on.
  void repeat(std::function<bool()> work);

  void add_sizes(Sizes& sizes) const override;
  void add_to(rcl_wait_set_t& set) override;
  void take(const rcl_wait_set_t& set) override;
  bool poll(Clock::time_point now) override;

 private:
  enum class Wish { None, Cancel, Hold };

  bool is_open(std::uint64_t activation) const {
    return state_ != State::Idle && goal_.activation == activation;
  }
  bool is_on_hold() const { return wish_ == Wish::Hold && !is_resumed_; }
  void set_state(State state);
  void begin(Goal goal);
  void send_again();
  void wait_for_server();
  void do_repeated();
  void end(Outcome outcome);
  void run_what_waits();
  void drop(std::uint64_t activation);
  bool has_server();
  void poll_for_server(Clock::time_point now);
  void poll_goal(Clock::time_point now);
  void send_goal();
  GoalId id_of(std::uint32_t number) const;
  void take_number(std::uint32_t number);
  void ask_for_old();
  void see_at_work();
  void take_unknown();
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

  // A goal that was halted before the server has accepted it.
  struct Unanswered {
    std::int64_t call;
    GoalId id;
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
  std::uint32_t number_ = 0;           // of the goal that was sent last
  std::optional<Stage> old_;           // its stage before a cut: it is not known what became of it
  std::function<bool()> repeated_;
  std::int64_t goal_call_ = 0, result_call_ = 0, cancel_call_ = 0;
  Clock::time_point deadline_, next_look_, cancel_until_, ask_again_;
  std::optional<Clock::time_point> server_since_;

  Message goal_response_, result_request_;
  std::unique_ptr<Message> result_, next_result_;
  TripleBuffer<Feedback> feedback_;
  std::atomic<std::uint64_t> ended_{0};  // the activation, and its outcome in the last 8 bits
  std::atomic<std::uint64_t> shown_{0};  // that of state_, the number and stage, and the state
  Lines lines_;
};

}  // namespace ros2
