#include "action_client.hpp"

#include <rcl/error_handling.h>
#include <rcl_action/wait.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "graph.hpp"

namespace ros2 {
namespace {

using namespace std::chrono_literals;

// After a server is seen first, its other channels may not be there yet.
constexpr auto kSettling = 50ms;
constexpr auto kBetweenLooks = 200ms;
constexpr auto kCancelLimit = 1s;
constexpr auto kBetweenAsks = 1s;

constexpr std::size_t kMostUnanswered = 16;

constexpr int kStateBits = 4, kStageBits = 4, kNumberBits = 24;

std::uint64_t bits_of(std::uint64_t shown, int from, int count) {
  return shown >> from & ((std::uint64_t{1} << count) - 1);
}

}  // namespace

GoalId new_goal_id() {
  static std::random_device device;
  GoalId id;
  for (std::size_t i = 0; i < id.size(); i += sizeof(unsigned)) {
    const unsigned bits = device();
    std::memcpy(id.data() + i, &bits, sizeof bits);
  }
  return id;
}

ActionClient::ActionClient(const ActionType& type, std::string action)
    : type_(type),
      action_(std::move(action)),
      client_(rcl_action_get_zero_initialized_client()),
      goal_response_(*type.goal_response),
      result_request_(*type.get_result),
      result_(std::make_unique<Message>(*type.result_response)),
      next_result_(std::make_unique<Message>(*type.result_response)),
      feedback_([&] {
        return std::unique_ptr<Feedback>(new Feedback{Message(*type.feedback_message)});
      }) {}

ActionClient::~ActionClient() {
  rcl_node_t& node = Middleware::get().node();
  if (is_made_ && rcl_action_client_fini(&client_, &node) != RCL_RET_OK) rcl_reset_error();
}

Outcome ActionClient::outcome(std::uint64_t activation) const {
  const std::uint64_t ended = ended_.load(std::memory_order_acquire);
  return ended >> 8 == activation ? static_cast<Outcome>(ended & 0xff) : Outcome::Open;
}

ActionClient::State ActionClient::state(std::uint64_t activation) const {
  const std::uint64_t shown = shown_.load(std::memory_order_relaxed);
  return shown >> 32 == activation ? static_cast<State>(bits_of(shown, 0, kStateBits))
                                   : State::Idle;
}

ActionClient::Sent ActionClient::sent(std::uint64_t activation) const {
  const std::uint64_t shown = shown_.load(std::memory_order_relaxed);
  if (shown >> 32 != activation) return {};
  return {static_cast<std::uint32_t>(bits_of(shown, kStateBits + kStageBits, kNumberBits)),
          static_cast<Stage>(bits_of(shown, kStateBits, kStageBits))};
}

void ActionClient::set_state(State state) {
  state_ = state;
  const Stage now = state == State::IsSent       ? Stage::Sent
                    : state == State::IsAccepted ? Stage::Accepted
                                                 : Stage::Unsent;
  const bool has_number = old_ || now != Stage::Unsent;
  const std::uint64_t number = bits_of(has_number ? number_ : number_ + 1, 0, kNumberBits);
  const State shown = old_ && state == State::IsAccepted ? State::IsAsked : state;
  shown_.store(goal_.activation << 32 | number << (kStateBits + kStageBits) |
                   static_cast<std::uint64_t>(old_.value_or(now)) << kStateBits |
                   static_cast<std::uint64_t>(shown),
               std::memory_order_relaxed);
}

void ActionClient::open() {
  const rcl_action_client_options_t options = rcl_action_client_get_default_options();
  const auto code = rcl_action_client_init(&client_, &Middleware::get().node(), type_.support,
                                           action_.c_str(), &options);
  is_made_ = code == RCL_RET_OK;
  if (!is_made_) why_not_made_ = last_ros_error();
}

void ActionClient::send(Goal goal) {
  if (state_ == State::Idle) return begin(std::move(goal));
  cancel(goal_.activation);
  if (state_ == State::Idle) return begin(std::move(goal));
  next_ = std::move(goal);
}

// The server is not asked to cancel the one before: it ends it for the new one.
void ActionClient::replace(Goal goal) {
  if (next_ && next_->activation == goal.activation) {
    next_ = std::move(goal);
    return;
  }
  if (!is_open(goal.activation)) return;
  // A goal that is on its way to be sent again is sent as the new one.
  std::memcpy(goal.request->get(), goal_.request->get(), kIdSize);
  goal.id = goal_.id;
  std::swap(goal_, goal);
  if (old_) {
    replaced_ = goal.request;  // the next one comes in its place, whatever became of it
    old_.reset();
  }
  if (state_ != State::IsSent && state_ != State::IsAccepted) return;
  replaced_ = std::move(goal.request);
  if (wish_ == Wish::None) send_goal();
}

void ActionClient::begin(Goal goal) {
  goal_ = std::move(goal);
  number_ = 0;
  send_again();
}

void ActionClient::send_again() {
  replaced_.reset();
  old_.reset();
  wish_ = Wish::None;
  is_canceling_ = is_resumed_ = false;
  wait_for_server();
}

void ActionClient::wait_for_server() {
  set_state(State::WaitsForServer);
  deadline_ = Clock::now() + lockstep::bounded(std::chrono::duration<double>(goal_.server_timeout));
  if (!is_made_) return fail("there is no client of '" + action_ + "': " + why_not_made_);
  poll_for_server(Clock::now());
}

void ActionClient::take_up(Goal goal, Sent sent, bool is_held) {
  goal_ = std::move(goal);
  take_number(sent.number);
  old_ = sent.stage;
  wish_ = is_held ? Wish::Hold : Wish::None;
  wait_for_server();
}

// The state that it shows stays: the leaf may still have to see that it has ended.
void ActionClient::end(Outcome outcome) {
  state_ = State::Idle;
  old_.reset();
  ended_.store(goal_.activation << 8 | static_cast<std::uint64_t>(outcome),
               std::memory_order_release);
  goal_.request.reset();
  run_what_waits();
  if (!next_) return;
  Goal next = std::move(*next_);
  next_.reset();
  begin(std::move(next));
}

void ActionClient::when_ended(std::uint64_t activation, std::function<void()> work) {
  when_ended_.emplace_back(activation, std::move(work));
  run_what_waits();
}

void ActionClient::run_what_waits() {
  const auto first = std::stable_partition(when_ended_.begin(), when_ended_.end(),
                                           [&](const auto& it) { return is_busy(it.first); });
  for (auto it = first; it != when_ended_.end(); ++it) it->second();
  when_ended_.erase(first, when_ended_.end());
}

// A goal that was never begun.
void ActionClient::drop(std::uint64_t activation) {
  if (!next_ || next_->activation != activation) return;
  // Whoever waits for it waits for the one before.
  goal_.activation = activation;
  next_.reset();
}

void ActionClient::cancel(std::uint64_t activation) {
  if (!is_open(activation)) return drop(activation);
  wish_ = Wish::Cancel;
  switch (state_) {
    case State::WaitsForServer:
      if (!old_) return end(Outcome::Canceled);
      cancel_until_ = Clock::now() + kCancelLimit;
      return;
    case State::IsHeld:
      return end(Outcome::Canceled);
    case State::IsAccepted:
      return ask_to_cancel();
    default:  // once it is accepted
      cancel_until_ = Clock::now() + kCancelLimit;
  }
}

void ActionClient::hold(std::uint64_t activation) {
  if (!is_open(activation)) return;
  wish_ = Wish::Hold;
  is_resumed_ = false;
  if (state_ == State::WaitsForServer && !old_) set_state(State::IsHeld);
  if (state_ == State::IsAccepted) ask_to_cancel();
}

void ActionClient::resume(std::uint64_t activation) {
  if (!is_open(activation) || wish_ != Wish::Hold) return;
  if (state_ == State::IsHeld) return send_again();
  is_resumed_ = true;
  if (old_) {
    deadline_ =
        Clock::now() + lockstep::bounded(std::chrono::duration<double>(goal_.server_timeout));
  } else if (!is_canceling_) {
    wish_ = Wish::None;  // it was not accepted yet
  }
}

void ActionClient::repeat(std::function<bool()> work) {
  repeated_ = std::move(work);
  do_repeated();
}

void ActionClient::do_repeated() {
  if (repeated_ && repeated_()) repeated_ = nullptr;
}

bool ActionClient::has_server() {
  bool is_there = false;
  if (rcl_action_server_is_available(&Middleware::get().node(), &client_, &is_there) !=
      RCL_RET_OK) {
    rcl_reset_error();
  }
  if (!is_there) server_since_.reset();
  if (is_there && !server_since_) server_since_ = Clock::now();
  return is_there;
}

bool ActionClient::poll(Clock::time_point now) {
  if (!is_made_) return false;
  do_repeated();
  switch (state_) {
    case State::WaitsForServer:
      poll_for_server(now);
      break;
    case State::IsSent:
    case State::IsAccepted:
      poll_goal(now);
      break;
    default:
      if (!server_since_) has_server();
  }
  return (state_ != State::Idle && state_ != State::IsHeld) || repeated_;
}

void ActionClient::poll_for_server(Clock::time_point now) {
  if (has_server()) {
    if (now - *server_since_ >= kSettling) old_ ? ask_for_old() : send_goal();
  } else if (wish_ == Wish::Cancel && now >= cancel_until_) {
    lines_.add("there is no server of '" + action_ +
               "' to cancel the goal that was sent before the cut");
    end(Outcome::Canceled);
  } else if (now >= deadline_ && !is_on_hold()) {
    const std::string others = has_told_ ? "" : other_actions(action_, type_.name);
    has_told_ |= !others.empty();
    if (!others.empty()) lines_.add(others);
    end(Outcome::NoServer);
  }
}

void ActionClient::poll_goal(Clock::time_point now) {
  if (wish_ == Wish::Cancel && now >= cancel_until_) {
    const bool is_accepted = state_ == State::IsAccepted;
    lines_.add("the server of '" + action_ + "' has not " + (is_accepted ? "ended" : "accepted") +
               " the goal within 1 s of the cancel");
    if (!is_accepted) leave_unanswered();
    return end(Outcome::Canceled);
  }
  if (old_ && now >= ask_again_) ask_for_result();
  if (state_ == State::Idle || now < next_look_) return;
  next_look_ = now + kBetweenLooks;
  if (has_server()) return;
  if (!old_ || !is_on_hold()) return end(Outcome::ServerLost);
  is_canceling_ = false;
  wait_for_server();
}

void ActionClient::send_goal() {
  next_look_ = Clock::now() + kBetweenLooks;
  take_number(number_ + 1);
  set_state(State::IsSent);
  if (rcl_action_send_goal_request(&client_, goal_.request->get(), &goal_call_) != RCL_RET_OK) {
    fail("the goal could not be sent: " + last_ros_error());
  }
}

GoalId ActionClient::id_of(std::uint32_t number) const {
  GoalId id = goal_.id;
  for (std::size_t i = 0; i < sizeof number; ++i) {
    id[i] = static_cast<unsigned char>(id[i] ^ number >> (8 * i));
  }
  return id;
}

void ActionClient::take_number(std::uint32_t number) {
  number_ = number;
  std::memcpy(goal_.request->get(), id_of(number).data(), kIdSize);
}

// The server answers at once if it does not know the goal, or if it has ended. Otherwise its
// feedback or its status comes.
void ActionClient::ask_for_old() {
  next_look_ = Clock::now() + kBetweenLooks;
  set_state(State::IsAccepted);
  ask_for_result();
  if (state_ == State::IsAccepted && wish_ != Wish::None) ask_to_cancel();
}

void ActionClient::see_at_work() {
  if (!old_ || state_ != State::IsAccepted) return;
  old_.reset();
  set_state(State::IsAccepted);
  if (wish_ != Wish::None && !is_canceling_) ask_to_cancel();
}

// If it was not accepted, the server may still accept it, or be at work for the one before it.
void ActionClient::take_unknown() {
  const Stage stage = *old_;
  for (std::uint32_t n = number_; stage != Stage::Accepted && n != 0 && n + 2 > number_; --n) {
    std::int64_t call = 0;
    if (!send_cancel(id_of(n).data(), call)) rcl_reset_error();
  }
  if (wish_ == Wish::Cancel) return end(Outcome::Canceled);
  if (stage != Stage::Unsent) return end(Outcome::Unknown);
  if (!is_on_hold()) return send_again();
  old_.reset();
  set_state(State::IsHeld);
}

void ActionClient::ask_for_result() {
  ask_again_ = Clock::now() + kBetweenAsks;
  std::memcpy(result_request_.get(), goal_.request->get(), kIdSize);
  if (rcl_action_send_result_request(&client_, result_request_.get(), &result_call_) !=
      RCL_RET_OK) {
    fail("the result could not be asked for: " + last_ros_error());
  }
}

void ActionClient::ask_to_cancel() {
  cancel_until_ = Clock::now() + kCancelLimit;
  if (is_canceling_) return;
  is_canceling_ = true;
  if (send_cancel(goal_.request->get(), cancel_call_)) return;
  fail("the goal could not be canceled: " + last_ros_error());
}

bool ActionClient::send_cancel(const void* id, std::int64_t& call) {
  rcl_action_cancel_request_t request = rcl_action_get_zero_initialized_cancel_request();
  std::memcpy(&request.goal_info.goal_id, id, kIdSize);
  return rcl_action_send_cancel_request(&client_, &request, &call) == RCL_RET_OK;
}

// The goal has been halted, and the server may still accept it. The cancel comes to a server that
// does one after the other when it has accepted; if it comes too early, another one follows.
void ActionClient::leave_unanswered() {
  if (unanswered_.size() == kMostUnanswered) unanswered_.erase(unanswered_.begin());
  Unanswered& it = unanswered_.emplace_back(Unanswered{goal_call_, {}});
  std::memcpy(it.id.data(), goal_.request->get(), kIdSize);
  std::int64_t call = 0;
  if (!send_cancel(it.id.data(), call)) rcl_reset_error();
}

void ActionClient::take_late_answer(std::int64_t call, bool is_accepted) {
  const auto it = std::find_if(unanswered_.begin(), unanswered_.end(),
                               [call](const Unanswered& goal) { return goal.call == call; });
  if (it == unanswered_.end()) return;
  std::int64_t cancel = 0;
  if (is_accepted && !send_cancel(it->id.data(), cancel)) rcl_reset_error();
  unanswered_.erase(it);
}

// A goal before it, which it was to replace, does not stay at work.
void ActionClient::reject() {
  std::int64_t call = 0;
  if (replaced_ != nullptr && !send_cancel(replaced_->get(), call)) rcl_reset_error();
  end(wish_ == Wish::Cancel ? Outcome::Canceled : Outcome::Rejected);
}

void ActionClient::fail(const std::string& what) {
  lines_.add(what);
  end(Outcome::Failed);
}

void ActionClient::add_sizes(Sizes& sizes) const {
  Sizes own;
  if (!is_made_ || rcl_action_client_wait_set_get_num_entities(
                       &client_, &own.subscriptions, &own.guards, &own.timers, &own.clients,
                       &own.services) != RCL_RET_OK) {
    return;
  }
  sizes.subscriptions += own.subscriptions;
  sizes.guards += own.guards;
  sizes.timers += own.timers;
  sizes.clients += own.clients;
  sizes.services += own.services;
}

void ActionClient::add_to(rcl_wait_set_t& set) {
  if (!is_made_) return;
  if (rcl_action_wait_set_add_action_client(&set, &client_, nullptr, nullptr) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

void ActionClient::take(const rcl_wait_set_t& set) {
  bool feedback = false, status = false, goal = false, canceled = false, result = false;
  if (!is_made_ ||
      rcl_action_client_wait_set_get_entities_ready(&set, &client_, &feedback, &status, &goal,
                                                    &canceled, &result) != RCL_RET_OK) {
    rcl_reset_error();
    return;
  }
  if (goal) take_goal_response();
  if (feedback) take_feedback();
  if (canceled) take_cancel_response();
  if (result) take_result();
  if (status) take_status();
}

void ActionClient::take_goal_response() {
  rmw_request_id_t id{};
  if (rcl_action_take_goal_response(&client_, &id, goal_response_.get()) != RCL_RET_OK) {
    rcl_reset_error();
    return;
  }
  const bool is_accepted = *goal_response_.at<bool>(type_.accepted);
  if (state_ != State::IsSent || id.sequence_number != goal_call_) {
    return take_late_answer(id.sequence_number, is_accepted);
  }
  if (!is_accepted) return reject();
  replaced_.reset();
  set_state(State::IsAccepted);
  ask_for_result();
  if (state_ == State::IsAccepted && wish_ != Wish::None) ask_to_cancel();
}

bool ActionClient::is_own(const Message& message) const {
  return goal_.request != nullptr && std::memcmp(message.get(), goal_.request->get(), kIdSize) == 0;
}

void ActionClient::take_feedback() {
  while (true) {
    Feedback& next = feedback_.back();
    next.message.reset();
    if (rcl_action_take_feedback(&client_, next.message.get()) != RCL_RET_OK) break;
    if (!is_own(next.message) || state_ == State::Idle) continue;
    next.activation = goal_.activation;
    next.number = number_;
    feedback_.publish();
    see_at_work();
  }
  rcl_reset_error();
}

void ActionClient::take_result() {
  rmw_request_id_t id{};
  next_result_->reset();
  if (rcl_action_take_result_response(&client_, &id, next_result_->get()) != RCL_RET_OK) {
    rcl_reset_error();
    return;
  }
  if (state_ != State::IsAccepted || id.sequence_number != result_call_) return;
  // action_msgs/msg/GoalStatus: 4 succeeded, 5 canceled, 6 aborted.
  const int status = *next_result_->at<std::int8_t>(type_.status);
  if (status == 0 && old_) return take_unknown();
  old_.reset();
  if (status == 5 && wish_ == Wish::Hold) {
    if (is_resumed_) return send_again();
    set_state(State::IsHeld);
    return;
  }
  std::swap(result_, next_result_);
  end(status == 4 ? Outcome::Succeeded : status == 5 ? Outcome::Canceled : Outcome::Aborted);
}

void ActionClient::take_cancel_response() {
  rmw_request_id_t id{};
  action_msgs__srv__CancelGoal_Response response{};
  action_msgs__srv__CancelGoal_Response__init(&response);
  const auto code = rcl_action_take_cancel_response(&client_, &id, &response);
  const int answer = response.return_code;
  const bool is_taken = response.goals_canceling.size > 0;
  action_msgs__srv__CancelGoal_Response__fini(&response);
  if (code != RCL_RET_OK) {
    rcl_reset_error();
    return;
  }
  if (!is_canceling_ || id.sequence_number != cancel_call_ || state_ != State::IsAccepted) return;
  // action_msgs/srv/CancelGoal: 3, it has ended already. Its result follows.
  if (is_taken || answer == 3) return;
  is_canceling_ = false;
  if (answer == 2 && old_) return;  // it does not know the goal: the result says so, too
  lines_.add("the server of '" + action_ + "' refuses to cancel the goal: the robot goes on");
  if (wish_ == Wish::Cancel) return end(Outcome::Canceled);
  wish_ = Wish::None;
  if (replaced_ != nullptr) send_goal();
}

// All goals that the server knows.
void ActionClient::take_status() {
  action_msgs__msg__GoalStatusArray status{};
  action_msgs__msg__GoalStatusArray__init(&status);
  if (rcl_action_take_status(&client_, &status) != RCL_RET_OK) rcl_reset_error();
  for (std::size_t i = 0; old_ && i < status.status_list.size; ++i) {
    const auto& it = status.status_list.data[i];
    // action_msgs/msg/GoalStatus: 1 accepted, 2 executing, 3 canceling.
    const bool is_at_work = it.status >= 1 && it.status <= 3;
    if (is_at_work && std::memcmp(&it.goal_info.goal_id, goal_.request->get(), kIdSize) == 0) {
      see_at_work();
    }
  }
  action_msgs__msg__GoalStatusArray__fini(&status);
}

}  // namespace ros2
