#include "ros_action.hpp"

#include <lockstep/ext/changes.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "action_client.hpp"
#include "elements.hpp"
#include "expression.hpp"
#include "hold.hpp"
#include "kept_goal.hpp"
#include "leaf_base.hpp"
#include "leaf_functions.hpp"
#include "pace.hpp"
#include "run_end.hpp"

namespace ros2 {
namespace {

enum Own : std::uint32_t {
  kType,
  kAction,
  kProgress,
  kHold,
  kHoldType,
  kOnFailure,
  kServerTimeout,
  kError,
  kPreempt,
  kPace,
  kPaceType,
  kPaceValue,
  kLeastPace,
  kPaceFound
};

constexpr std::uint64_t kFixedOptional = LOCKSTEP_FIXED | LOCKSTEP_OPTIONAL;

constexpr lockstep_port kOwnPorts[] = {
    input("type", LOCKSTEP_STRING, nullptr, "The type: nav2_msgs/action/NavigateToPose.",
          LOCKSTEP_FIXED),
    input("action", LOCKSTEP_STRING, nullptr, "The action's name: /navigate_to_pose.",
          LOCKSTEP_FIXED),
    input("progress", LOCKSTEP_STRING, nullptr,
          "The progress from 0 to 1, of goal.FIELD, feedback.FIELD, elapsed, first(…), size(…).",
          kFixedOptional),
    input("hold", LOCKSTEP_STRING, nullptr,
          "While the leaf is held: cancel (the goal is canceled and sent again), service:NAME, "
          "topic:NAME (the robot gets true, then false), pace (it gets the pace 0) or nothing (the "
          "robot goes on).",
          kFixedOptional),
    input("hold_type", LOCKSTEP_STRING, nullptr,
          "The type of that service or topic; std_srvs/srv/SetBool, std_msgs/msg/Bool if left out.",
          kFixedOptional),
    kOnFailurePort,
    {sizeof(lockstep_port), LOCKSTEP_NUMBER, LOCKSTEP_INPUT, "server_timeout", "5", "s",
     "How long to wait for a server that is not there.", nullptr, 0, HUGE_VAL, nullptr, 0},
    {sizeof(lockstep_port), LOCKSTEP_STRING, LOCKSTEP_OUTPUT, "error", nullptr, nullptr,
     "Why it failed: rejected, aborted, canceled, no server, server lost, goal unknown.", nullptr,
     0, 0, nullptr, 0},
    input("preempt", LOCKSTEP_BOOL, "false",
          "While the goal is at work and an entry of it changes, the new goal is sent. For servers "
          "that end the one before, as those of Nav2 do.",
          LOCKSTEP_FIXED),
    input("pace", LOCKSTEP_STRING, nullptr,
          "How the robot gets its factor below a node with pace=\"true\": topic:NAME, service:NAME "
          "or parameter:NODE/NAME. The previous value is restored at the end.",
          kFixedOptional),
    input("pace_type", LOCKSTEP_STRING, nullptr,
          "The type of that topic or service; control_msgs/msg/SpeedScalingFactor, "
          "ur_msgs/srv/SetSpeedSliderFraction if left out.",
          kFixedOptional),
    input("pace_value", LOCKSTEP_STRING, nullptr,
          "The value for a factor, an expression over factor such as 100 * factor; factor if left "
          "out. It is the first number of the message or request.",
          kFixedOptional),
    {sizeof(lockstep_port), LOCKSTEP_NUMBER, LOCKSTEP_INPUT, "least_pace", "0.05", nullptr,
     "The least factor that the robot gets.", nullptr, 0, 1, nullptr, 0},
    input(
        "pace_found", LOCKSTEP_NUMBER, nullptr,
        "The value to restore, if it cannot be read. If left out: the value that was read, or that "
        "for factor 1.",
        LOCKSTEP_OPTIONAL),
};

// One element's: what its constants say, and the ports that follow from that.
struct ActionElement {
  ActionElement(const ActionType& of, const NamedLeaf* named) : type(of), ports(kOwnPorts, named) {}

  const ActionType& type;
  std::string action;
  Expression progress;
  bool needs_feedback = false;
  Hold hold;
  Pace pace;
  bool faults = false, preempts = false;
  PortList ports;
  FieldPorts goal, feedback, result, pace_fields;
  lockstep_leaf_type leaf{};
};

const char* words_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::Aborted:
      return "aborted";
    case Outcome::Canceled:
      return "canceled";
    case Outcome::Rejected:
      return "rejected";
    case Outcome::NoServer:
      return "no server";
    case Outcome::ServerLost:
      return "server lost";
    case Outcome::Unknown:
      return "goal unknown";
    default:
      return "not sent";
  }
}

class RosAction : public LeafBase {
 public:
  RosAction(const lockstep_host& host, const lockstep_caller* caller, void* run)
      : LeafBase(host, caller),
        element_(element_of<ActionElement>(host, caller)),
        run_end_(*static_cast<RunEnd*>(run)),
        client_(std::make_shared<ActionClient>(element_.type, element_.action)),
        hold_(element_.hold.way == Hold::Way::Tell ? make_teller(element_.hold.target, "default")
                                                   : nullptr),
        pace_(element_.pace.is_given ? PaceSignal::of(element_.pace) : nullptr),
        user_(std::make_shared<PaceSignal::User>(element_.pace)),
        feedback_ports_(given(element_.feedback)),
        result_ports_(given(element_.result)),
        watched_(element_.preempts ? given(element_.goal) : FieldPorts()) {
    Middleware::get().post([client = client_, hold = hold_, pace = pace_] {
      client->open();
      Middleware::get().add(client);
      if (hold != nullptr) hold->open();
      if (pace != nullptr) pace->open();
    });
  }

  // A goal that was canceled is waited for, and a robot that is slow, as long as the run's end may
  // take.
  ~RosAction() {
    run_end_.wait([&] {
      return !client_->is_busy(activation_) && (pace_ == nullptr || !user_->is_busy(activation_));
    });
    log_all_lines();
    Middleware::get().post([client = std::move(client_), hold = std::move(hold_),
                            pace = std::move(pace_), user = std::move(user_)] {
      Middleware::get().remove(client.get());
      if (hold != nullptr) hold->close();
      if (pace != nullptr) pace->close(user);
    });
  }
  RosAction(const RosAction&) = delete;
  RosAction& operator=(const RosAction&) = delete;

  void start() {
    if (!read_goal() || (pace_ != nullptr && !begin_pace(activation_ + 1))) return;
    ++activation_;
    id_ = new_goal_id();
    is_held_ = is_behind_ = false;
    progress_ = held_progress_ = 0;
    began_ = now();
    memory_ = element_.progress.memory();
    number_ = 0;
    Middleware::get().post([client = client_, goal = goal()] { client->send(goal); });
  }

  lockstep_status tick() {
    log_all_lines();
    // The result first: all feedback came before it.
    const Outcome outcome = client_->outcome(activation_);
    take_feedback();
    if (outcome == Outcome::Open) {
      if (has_another_goal() || is_behind_) preempt();
      return waits();
    }
    if (outcome == Outcome::Unknown && on_resume_ != LOCKSTEP_FAILURE) return end_unknown();
    end_hold_and_pace();
    const bool has_result = outcome == Outcome::Succeeded || outcome == Outcome::Aborted ||
                            outcome == Outcome::Canceled;
    if (has_result) write(result_ports_, client_->result());
    if (outcome == Outcome::Succeeded) return LOCKSTEP_SUCCESS;
    return failed(kError, "the action '" + element_.action + "'", ros2::words_of(outcome),
                  element_.faults, has_result ? words_of_result() : std::string());
  }

  void halt() {
    Middleware::get().post([client = client_, it = activation_] { client->cancel(it); });
    end_hold_and_pace();
  }

  void pause() {
    held_since_ = now();
    held_progress_ = progress_;
    hold(true);
  }

  void resume() {
    began_ += now() - held_since_;
    hold(false);
  }

  double set_pace(double factor) {
    const double taken = factor_ = std::clamp(factor, least_pace_, 1.0);
    Middleware::get().post([pace = pace_, user = user_, taken] { pace->slow(*user, taken); });
    return pace_->is_heard() ? taken : 1;
  }

  // It reports what it has reached until the state of its goal is known.
  double progress() {
    take_feedback();
    if (client_->outcome(activation_) == Outcome::Unknown) return 0;
    if (element_.needs_feedback) return progress_;
    measure(nullptr);
    return progress_;
  }

  // A goal is written once, when it is another one.
  std::size_t save(void* bytes, std::size_t room) {
    is_behind_ |= has_another_goal();
    if (!kept_goal_) kept_goal_ = bytes_of(*element_.type.goal_message, goal_in(*goal_));
    KeptGoal kept{{}, memory_, *kept_goal_};
    kept.facts = {id_,
                  client_->sent(activation_),
                  number_,
                  is_behind_,
                  user_->is_told(),
                  user_->found(),
                  progress_,
                  held_progress_,
                  began_,
                  held_since_};
    const std::size_t size = kept.write(bytes, room);
    if (size <= room) return size;
    kept.goal = {};
    return kept.write(bytes, room);
  }

  lockstep_after_cut restore(std::string_view bytes, const lockstep_cut& cut) {
    const auto kept = read_kept_goal(bytes, element_.progress.memory().size());
    if (!kept || !read_goal(kept->goal)) return LOCKSTEP_STARTS_AGAIN;
    const KeptGoal::Facts& facts = kept->facts;
    if (pace_ != nullptr && !begin_pace(activation_ + 1, &facts)) return LOCKSTEP_STARTS_AGAIN;
    ++activation_;
    on_resume_ = cut.on_resume;
    id_ = facts.id;
    number_ = facts.number;
    is_behind_ = facts.is_behind;
    is_held_ = cut.held && element_.leaf.pause != nullptr;
    progress_ = facts.progress;
    held_progress_ = facts.held_progress;
    held_since_ = facts.held_since;
    // The robot did not stop for the cut.
    const bool was_at_work = !is_held_ && facts.sent.stage != ActionClient::Stage::Unsent;
    began_ = facts.began - (was_at_work ? cut.gap : 0);
    memory_ = kept->memory;
    const ActionClient::Goal goal = this->goal();
    tell_until_ =
        Clock::now() + lockstep::bounded(std::chrono::duration<double>(goal.server_timeout));
    const bool is_canceled = is_held_ && element_.hold.way == Hold::Way::Cancel;
    Middleware::get().post([client = client_, goal, sent = facts.sent, is_canceled] {
      client->take_up(goal, sent, is_canceled);
    });
    if (is_held_ && !is_canceled) hold(true);
    return LOCKSTEP_CONTINUES;
  }

 private:
  using State = ActionClient::State;

  lockstep_status waits() {
    const State state = this->state();
    const int feedback = number_ != 0 || element_.type.feedback.empty() ? 0 : 100;
    return LeafBase::waits(static_cast<int>(state) + feedback, [&] { return words_of(state); });
  }
  // The server does not know the goal that was sent before the cut.
  lockstep_status end_unknown() {
    std::string line = "the server of '" + element_.action +
                       "' does not know the goal that was sent before the cut: ";
    const bool succeeds = on_resume_ == LOCKSTEP_SUCCESS;
    line += succeeds ? "it counts as succeeded" : "it is sent again";
    host_.log(caller_, LOCKSTEP_LOG_WARNING, line.c_str());
    end_hold_and_pace();
    if (succeeds) return LOCKSTEP_SUCCESS;
    start();
    if (pace_ != nullptr && factor_ < 1) set_pace(factor_);
    return waits();
  }

  State state() const {
    const State state = client_->state(activation_);
    const bool is_next = state == State::Idle && client_->is_busy(activation_ - 1);
    return state == State::Idle && !is_next ? State::WaitsForServer : state;
  }
  std::string words_of(State state) const {
    const std::string name = "'" + element_.action + "'";
    switch (state) {
      case State::WaitsForServer:
        return "waits for the server of " + name;
      case State::IsSent:
        return "waits for the server of " + name + " to accept the goal";
      case State::IsAccepted:
        return "the server of " + name + " has accepted the goal" +
               (number_ == 0 && !element_.type.feedback.empty() ? ", no feedback yet" : "");
      case State::IsAsked:
        return "asks the server of " + name + " for the goal that was sent before the cut";
      default:
        return "waits for the end of the goal before it at " + name;
    }
  }
  std::string words_of_result() const {
    return element_.type.result_words.text(client_->result().get());
  }

  bool read_goal() {
    has_another_goal();
    goal_ = std::make_shared<Message>(*element_.type.send_goal);
    kept_goal_.reset();
    return read(element_.goal, *goal_);
  }
  // As it was before a cut: an entry may have changed since it was read.
  bool read_goal(std::string_view kept) {
    if (kept.empty()) return read_goal();
    has_another_goal();
    goal_ = std::make_shared<Message>(*element_.type.send_goal);
    kept_goal_ = kept;
    return read_bytes(*element_.type.goal_message, kept, goal_in(*goal_));
  }
  void* goal_in(Message& request) const { return request.at(element_.type.goal_in_request); }
  ActionClient::Goal goal() const { return {activation_, goal_, number(kServerTimeout), id_}; }

  // Whether an entry of the goal has changed since the last call.
  bool has_another_goal() {
    bool has_changed = false;
    for (const auto& [port, field] : watched_) has_changed |= changes_->changed(caller_, port);
    return has_changed;
  }

  void preempt() {
    is_behind_ = false;
    if (!read_goal()) return;
    held_progress_ = 0;  // the new goal may be farther away
    Middleware::get().post([client = client_, goal = goal()] { client->replace(goal); });
  }

  // False after an error. `kept`: of the same activation, before a cut.
  bool begin_pace(std::uint64_t activation, const KeptGoal::Facts* kept = nullptr) {
    least_pace_ = number(kLeastPace);
    factor_ = 1;
    std::shared_ptr<Message> message;
    const Target& target = element_.pace.target;
    if (target.way != Target::Way::Parameter) {
      message = std::make_shared<Message>(target.members());
      if (!read(element_.pace_fields, *message)) return false;
    }
    std::optional<double> found;
    if (is_given(host_, caller_, kPaceFound)) found = number(kPaceFound);
    const bool is_slowed = kept != nullptr && kept->is_slowed;
    if (is_slowed && !std::isnan(kept->found_pace)) found = kept->found_pace;
    Middleware::get().post([pace = pace_, user = user_, activation, message, found, is_slowed] {
      pace->begin(user, activation, message, found);
      if (is_slowed) pace->tell_again();
    });
    return true;
  }

  // What the robot was told is taken back when it does not move any more.
  void end_hold_and_pace() {
    const auto hold = is_held_ ? hold_ : nullptr;
    if (pace_ == nullptr && hold == nullptr) return;
    Middleware::get().post([client = client_, it = activation_, pace = pace_, user = user_, hold] {
      client->when_ended(it, [client = client.get(), it, pace, user, hold] {
        if (hold != nullptr) tell(*client, *hold, false);
        if (pace != nullptr) pace->end(user, it);
      });
    });
  }

  void hold(bool held) {
    is_held_ = held;
    if (element_.hold.way == Hold::Way::Pace) {
      Middleware::get().post([pace = pace_, user = user_, held] { pace->hold(*user, held); });
    } else if (hold_ != nullptr) {
      Middleware::get().post([client = client_, hold = hold_, held, until = tell_until_] {
        client->repeat([client = client.get(), hold, held, until] {
          if (hold->listeners().empty() && Clock::now() < until) return false;
          tell(*client, *hold, held);
          return true;
        });
      });
    } else {
      Middleware::get().post([client = client_, it = activation_, held] {
        held ? client->hold(it) : client->resume(it);
      });
    }
  }

  static void tell(ActionClient& client, Teller& robot, bool held) {
    const std::string wrong = robot.tell(held ? 1 : 0);
    if (wrong.empty()) return;
    client.lines().add(wrong + (held ? ": the robot goes on" : ": the robot is not told to go on"));
  }

  void log_all_lines() {
    log_lines(*client_);
    if (pace_ != nullptr) log_lines(*pace_);
  }

  void take_feedback() {
    if (!client_->feedback().update()) return;
    ActionClient::Feedback& feedback = client_->feedback().front();
    if (feedback.activation != activation_) return;
    write(feedback_ports_, feedback.message);
    if (element_.needs_feedback) measure(feedback.message.get());
    if (number_ != 0 && feedback.number != number_) compare_with_held();
    number_ = feedback.number;
  }

  void measure(const void* feedback) {
    const Expression::Inputs inputs{
        {&element_.type.goal, goal_->get()}, {&element_.type.feedback, feedback}, now() - began_};
    const auto value = element_.progress.value(inputs, memory_);
    if (value) progress_ = std::clamp(*value, 0.0, 1.0);
  }

  // The first feedback after the goal was sent again.
  void compare_with_held() {
    constexpr double kFall = 0.05;
    if (progress_ >= held_progress_ - kFall || has_warned_) return;
    has_warned_ = true;
    char text[240];
    std::snprintf(text, sizeof text,
                  "its progress fell from %.2f to %.2f after the goal was sent again: the server "
                  "begins where it began first, and hold=\"cancel\" is not for it",
                  held_progress_, progress_);
    host_.log(caller_, LOCKSTEP_LOG_WARNING, text);
  }

  const ActionElement& element_;
  RunEnd& run_end_;
  std::shared_ptr<ActionClient> client_;
  std::shared_ptr<Teller> hold_;      // who tells the robot that it is held; may be null
  std::shared_ptr<PaceSignal> pace_;  // may be null
  std::shared_ptr<PaceSignal::User> user_;
  const FieldPorts feedback_ports_, result_ports_;  // that the tree binds
  const FieldPorts watched_;                        // of the goal; empty: it stays as it was sent
  const lockstep_changes* const changes_ =
      static_cast<const lockstep_changes*>(host_.get_extension(LOCKSTEP_CHANGES));

  std::shared_ptr<Message> goal_;
  std::optional<std::string> kept_goal_;  // as save writes it
  std::uint64_t activation_ = 0;
  GoalId id_ = {};
  std::uint32_t number_ = 0;        // of the last feedback's goal; 0: none has come
  bool is_behind_ = false;          // an entry of the goal has changed since it was sent
  std::uint8_t on_resume_ = 0;      // of lockstep_cut
  Clock::time_point tell_until_{};  // after a cut, the robot may have to be found first
  double factor_ = 1;               // the pace
  double progress_ = 0, held_progress_ = 0, began_ = 0, held_since_ = 0, least_pace_ = 0;
  Expression::Memory memory_;
  bool has_warned_ = false, is_held_ = false;
};

constexpr const char* kDoc =
    "Sends a goal to an action server of ROS 2, of any type, and is done when the goal is. The "
    "attributes goal.FIELD are the goal; result.FIELD and feedback.FIELD are put into entries. "
    "With "
    "pace, message.FIELD or request.FIELD are the other fields of what slows the robot.";

lockstep_leaf_type base_type() {
  lockstep_leaf_type type = LeafFunctions<RosAction>::type("RosAction", kDoc);
  type.start_unreset = nullptr;  // a goal that was reached is not sent again
  type.save = LeafFunctions<RosAction>::save;
  type.restore = LeafFunctions<RosAction>::restore;
  static const PortList ports(kOwnPorts);
  ports.give_to(type);
  return type;
}

void describe_ports(ActionElement& element) {
  element.goal = element.ports.add("goal.", element.type.goal, LOCKSTEP_INPUT);
  element.feedback = element.ports.add("feedback.", element.type.feedback, LOCKSTEP_OUTPUT);
  element.result = element.ports.add("result.", element.type.result, LOCKSTEP_OUTPUT);
  if (element.pace.is_given) {
    const bool is_topic = element.pace.target.way == Target::Way::Topic;
    element.pace_fields = element.ports.add(is_topic ? "message." : "request.",
                                            element.pace.target.fields(), LOCKSTEP_INPUT);
  }
  element.leaf = base_type();
  element.ports.give_to(element.leaf);
  using Functions = LeafFunctions<RosAction>;
  if (!element.progress.is_empty()) element.leaf.progress = Functions::progress;
  if (element.pace.is_given) element.leaf.set_pace = Functions::set_pace;
  const auto way = element.hold.way;
  if (way != Hold::Way::Undecided && way != Hold::Way::Nothing) {
    element.leaf.pause = Functions::pause;
    element.leaf.resume = Functions::resume;
  }
}

std::unique_ptr<ActionElement> make_element(const FixedTexts& texts, Refusal& refusal) {
  auto type = action_type(texts[kOwnPorts[kType]]);
  if (!type) {
    refusal = {&kOwnPorts[kType], type.problem()};
    return nullptr;
  }
  auto element = std::make_unique<ActionElement>(**type, texts.named());
  element->action = texts[kOwnPorts[kAction]];
  element->faults = texts[kOwnPorts[kOnFailure]] == "fault";
  element->preempts = texts[kOwnPorts[kPreempt]] == "true";
  if (const std::string text = texts[kOwnPorts[kProgress]]; !text.empty()) {
    auto progress = read_progress(text, element->type.goal, element->type.feedback);
    if (!progress) {
      refusal = {&kOwnPorts[kProgress], progress.problem()};
      return nullptr;
    }
    element->progress = std::move(*progress);
    element->needs_feedback = element->progress.uses_second();
  }
  const lockstep_port* wrong = nullptr;
  auto pace =
      read_pace(texts, kOwnPorts[kPace], kOwnPorts[kPaceType], kOwnPorts[kPaceValue], wrong);
  if (!pace) {
    refusal = {wrong, pace.problem()};
    return nullptr;
  }
  element->pace = std::move(*pace);
  auto hold = read_hold(texts[kOwnPorts[kHold]], texts[kOwnPorts[kHoldType]]);
  std::optional<Problem> no_hold;
  if (!hold) no_hold = hold.problem();
  if (hold && hold->way == Hold::Way::Pace) no_hold = why_no_hold(element->pace);
  if (no_hold) {
    refusal = {&kOwnPorts[kHold], *no_hold};
    return nullptr;
  }
  element->hold = *hold;
  describe_ports(*element);
  if (texts.named() != nullptr) element->leaf.id = texts.named()->id.c_str();
  return element;
}

const lockstep_leaf_type* describe(const lockstep_fixed* fixed, std::uint32_t count,
                                   lockstep_refusal* why) {
  return described<ActionElement>(fixed, count, why, make_element);
}

}  // namespace

const lockstep_leaf_type& ros_action() {
  static const lockstep_leaf_type type = [] {
    lockstep_leaf_type base = base_type();
    base.more_ports =
        "goal;goal.*;feedback;feedback.*;result;result.*;message;message.*;request;request.*";
    base.describe = describe;
    // An element may have them.
    base.progress = LeafFunctions<RosAction>::progress;
    base.pause = LeafFunctions<RosAction>::pause;
    base.resume = LeafFunctions<RosAction>::resume;
    base.set_pace = LeafFunctions<RosAction>::set_pace;
    return base;
  }();
  return type;
}

}  // namespace ros2
