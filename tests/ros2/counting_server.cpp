// An action server of example_interfaces/action/Fibonacci for the tests: it counts to `order`, one
// step each `--step` ms, and tells of each step. What it does besides is said by options:
//   --keep       a goal goes on where the one before it stopped, as a robot that has a position
//   --reject     takes no goal          --abort N   aborts at the step N
//   --refuse     refuses to cancel      --die N     kills itself at the step N
//   --quit N     lets somebody else cancel the goal at the step N
//   --preempt    a goal aborts the one before it, as one of Nav2 does
//   --reject-order N: takes no goal with this order
//   --tell       prints each step, "at 3"
//   --accept-after N: answers a goal after N ms
//   --hold-service NAME, --hold-topic NAME: stands while it is true
//   --pace KIND:NAME: is as slow as it is told, by a topic or service: of real (a Float64), percent
//     (an Int16), sum (AddTwoInts, a percent), and, if their packages are there, scaling
//     (SpeedScalingFactor), limit (SpeedLimit) and slider (SetSpeedSliderFraction)
//   --panel V: somebody else has set the pace V before, on a topic of real or scaling
//   --refuse-pace: the service answers that it is not so
// Its parameter `speed` is a pace, too: 0.5 is full speed.
// It prints one line for each thing that happens to it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "example_interfaces/action/fibonacci.hpp"
#include "example_interfaces/srv/add_two_ints.hpp"
#include "example_interfaces/srv/set_bool.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_action/rclcpp_action.hpp"
#include "std_msgs/msg/bool.hpp"
#include "std_msgs/msg/float64.hpp"
#include "std_msgs/msg/int16.hpp"
#ifdef HAS_CONTROL_MSGS
#include "control_msgs/msg/speed_scaling_factor.hpp"
#endif
#ifdef HAS_NAV2_MSGS
#include "nav2_msgs/msg/speed_limit.hpp"
#endif
#ifdef HAS_UR_MSGS
#include "ur_msgs/srv/set_speed_slider_fraction.hpp"
#endif

namespace {

using Fibonacci = example_interfaces::action::Fibonacci;
using GoalHandle = rclcpp_action::ServerGoalHandle<Fibonacci>;
using SetBool = example_interfaces::srv::SetBool;

struct Options {
  std::string node = "counting_server_" + std::to_string(getpid());
  std::string action = "/count", hold_service, hold_topic, pace, panel;
  int step = 20, abort_at = -1, die_at = -1, quit_at = -1, reject_order = -1, accept_after = 0;
  bool keeps = false, rejects = false, refuses = false, preempts = false, refuses_pace = false,
       tells = false;
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto text = [&] { return i + 1 < argc ? std::string(argv[++i]) : std::string(); };
    const auto number = [&] { return std::atoi(text().c_str()); };
    if (word == "--action") options.action = text();
    if (word == "--node") options.node = text();
    if (word == "--hold-service") options.hold_service = text();
    if (word == "--hold-topic") options.hold_topic = text();
    if (word == "--pace") options.pace = text();
    if (word == "--panel") options.panel = text();
    if (word == "--refuse-pace") options.refuses_pace = true;
    if (word == "--step") options.step = number();
    if (word == "--abort") options.abort_at = number();
    if (word == "--die") options.die_at = number();
    if (word == "--quit") options.quit_at = number();
    if (word == "--reject-order") options.reject_order = number();
    if (word == "--accept-after") options.accept_after = number();
    if (word == "--preempt") options.preempts = true;
    if (word == "--keep") options.keeps = true;
    if (word == "--tell") options.tells = true;
    if (word == "--reject") options.rejects = true;
    if (word == "--refuse") options.refuses = true;
  }
  return options;
}

void say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

class CountingServer : public rclcpp::Node {
 public:
  explicit CountingServer(Options options) : Node(options.node), options_(std::move(options)) {
    server_ = rclcpp_action::create_server<Fibonacci>(
        this, options_.action,
        [this](const rclcpp_action::GoalUUID&, std::shared_ptr<const Fibonacci::Goal> goal) {
          say("goal " + std::to_string(goal->order));
          std::this_thread::sleep_for(std::chrono::milliseconds(options_.accept_after));
          const bool is_rejected = options_.rejects || goal->order == options_.reject_order;
          return is_rejected ? rclcpp_action::GoalResponse::REJECT
                             : rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE;
        },
        [this](std::shared_ptr<GoalHandle>) {
          say("cancel");
          return options_.refuses ? rclcpp_action::CancelResponse::REJECT
                                  : rclcpp_action::CancelResponse::ACCEPT;
        },
        [this](std::shared_ptr<GoalHandle> goal) { accept(std::move(goal)); });
    client_ = rclcpp_action::create_client<Fibonacci>(this, options_.action);
    timer_ = create_wall_timer(std::chrono::milliseconds(options_.step), [this] { step(); });
    if (!options_.hold_service.empty()) {
      service_ = create_service<SetBool>(options_.hold_service,
                                         [this](std::shared_ptr<SetBool::Request> request,
                                                std::shared_ptr<SetBool::Response> response) {
                                           hold(request->data);
                                           response->success = true;
                                         });
    }
    if (!options_.hold_topic.empty()) {
      subscription_ = create_subscription<std_msgs::msg::Bool>(
          options_.hold_topic, 10,
          [this](std_msgs::msg::Bool::ConstSharedPtr message) { hold(message->data); });
    }
    listen_to_pace();
    declare_parameter("speed", 0.5);
    declare_parameter("label", "slow");
    declare_parameter("percent", 80);
    parameters_ = add_on_set_parameters_callback([this](const auto& all) { return set(all); });
    say("ready");
  }
  // The handle of a goal that is open throws in its destructor when ROS has shut down.
  ~CountingServer() override { new std::vector<Goal>(std::move(goals_)); }

 private:
  void hold(bool held) {
    held_ = held;
    say(held ? "hold" : "go on");
  }

  void listen_to_pace() {
    using Scaling = std_msgs::msg::Float64;
    const auto colon = options_.pace.find(':');
    const std::string kind = options_.pace.substr(0, colon);
    const std::string name = options_.pace.substr(colon + 1);
    if (kind == "real") hear<Scaling>(name, [](const auto& it) { return it.data; });
    if (kind == "percent")
      hear<std_msgs::msg::Int16>(name, [](auto& it) { return it.data / 100.0; });
    if (kind == "sum")
      serve<example_interfaces::srv::AddTwoInts>(name, [](auto& in, auto& out) {
        out.sum = in.a + in.b;
        return in.a / 100.0;
      });
    if (!options_.panel.empty() && kind == "real") set_on_panel<Scaling>(name, &Scaling::data);
#ifdef HAS_CONTROL_MSGS
    using Factor = control_msgs::msg::SpeedScalingFactor;
    if (kind == "scaling")
      hear<Factor>(
          name, [](const auto& it) { return it.factor; }, true);
    if (!options_.panel.empty() && kind == "scaling") set_on_panel<Factor>(name, &Factor::factor);
#endif
#ifdef HAS_NAV2_MSGS
    if (kind == "limit")
      hear<nav2_msgs::msg::SpeedLimit>(name, [](const auto& it) {
        return !it.percentage || it.speed_limit == 0 ? 1 : it.speed_limit / 100;
      });
#endif
#ifdef HAS_UR_MSGS
    if (kind == "slider")
      serve<ur_msgs::srv::SetSpeedSliderFraction>(name, [this](const auto& in, auto& out) {
        out.success = !options_.refuses_pace && in.speed_slider_fraction >= 0.01;
        return out.success ? in.speed_slider_fraction : pace_;
      });
#endif
  }
  void set_pace(double pace) {
    pace_ = pace;
    char text[40];
    std::snprintf(text, sizeof text, "pace %.3f", pace);
    say(text);
  }
  // As robots do: most forget what was said before they came.
  template <class T, class Get>
  void hear(const std::string& topic, Get get, bool is_latched = false) {
    const auto qos = is_latched ? rclcpp::QoS(1).transient_local() : rclcpp::QoS(10);
    pace_topic_ = create_subscription<T>(
        topic, qos, [this, get](typename T::ConstSharedPtr it) { set_pace(get(*it)); });
  }
  template <class T, class Set>
  void serve(const std::string& service, Set set) {
    pace_service_ = create_service<T>(
        service, [this, set](typename T::Request::SharedPtr in,
                             typename T::Response::SharedPtr out) { set_pace(set(*in, *out)); });
  }
  template <class T>
  void set_on_panel(const std::string& topic, double T::*member) {
    const auto panel = create_publisher<T>(topic, rclcpp::QoS(1).transient_local());
    T message;
    message.*member = std::atof(options_.panel.c_str());
    panel->publish(message);
    panel_ = panel;
  }
  rcl_interfaces::msg::SetParametersResult set(const std::vector<rclcpp::Parameter>& all) {
    for (const auto& it : all) {
      if (it.get_name() == "speed") set_pace(it.as_double() / 0.5);
      if (it.get_name() == "percent") set_pace(static_cast<double>(it.as_int()) / 100);
    }
    rcl_interfaces::msg::SetParametersResult result;
    result.successful = !options_.refuses_pace;
    return result;
  }

  struct Goal {
    std::shared_ptr<GoalHandle> handle;
    int count = 0;
  };

  void accept(std::shared_ptr<GoalHandle> handle) {
    if (options_.preempts) {
      for (const Goal& goal : goals_) {
        goal.handle->abort(std::make_shared<Fibonacci::Result>());
        end(goal, "preempted", goal.count);
      }
      goals_.clear();
    }
    if (goals_.empty()) timer_->reset();  // the first step of a goal takes as long as the others
    goals_.push_back({std::move(handle), options_.keeps ? kept_ : 0});
  }

  void step() {
    way_ += std::clamp(pace_, 0.0, 1.0);
    if (way_ < 1 && pace_ > 0) return;
    way_ -= std::floor(way_);
    const auto has_ended = [this](Goal& goal) { return step(goal); };
    goals_.erase(std::remove_if(goals_.begin(), goals_.end(), has_ended), goals_.end());
  }

  static std::vector<int> counted(const Goal& goal) {
    std::vector<int> all(static_cast<std::size_t>(goal.count));
    std::iota(all.begin(), all.end(), 1);
    return all;
  }

  bool end(const Goal& goal, const char* word, int kept) {
    say(std::string(word) + " " + std::to_string(goal.count));
    kept_ = kept;
    return true;
  }

  // Returns whether it has ended.
  bool step(Goal& goal) {
    auto result = std::make_shared<Fibonacci::Result>();
    result->sequence = counted(goal);
    if (goal.handle->is_canceling()) {
      goal.handle->canceled(result);
      return end(goal, "canceled", goal.count);
    }
    if (held_ || pace_ <= 0) return false;
    ++goal.count;
    result->sequence = counted(goal);
    auto feedback = std::make_shared<Fibonacci::Feedback>();
    feedback->sequence = result->sequence;
    goal.handle->publish_feedback(feedback);
    if (options_.tells) say("at " + std::to_string(goal.count));
    if (goal.count == options_.die_at) std::raise(SIGKILL);
    if (goal.count == options_.quit_at) client_->async_cancel_all_goals();
    if (goal.count == options_.abort_at) {
      goal.handle->abort(result);
      return end(goal, "aborted", 0);
    }
    if (goal.count < goal.handle->get_goal()->order) return false;
    goal.handle->succeed(result);
    return end(goal, "succeeded", 0);
  }

  const Options options_;
  rclcpp_action::Server<Fibonacci>::SharedPtr server_;
  rclcpp::Service<SetBool>::SharedPtr service_;
  rclcpp::Subscription<std_msgs::msg::Bool>::SharedPtr subscription_;
  rclcpp::TimerBase::SharedPtr timer_;
  rclcpp_action::Client<Fibonacci>::SharedPtr client_;  // cancels all goals, as anybody may
  std::vector<Goal> goals_;
  int kept_ = 0;
  bool held_ = false;
  rclcpp::SubscriptionBase::SharedPtr pace_topic_;
  rclcpp::ServiceBase::SharedPtr pace_service_;
  rclcpp::PublisherBase::SharedPtr panel_;
  OnSetParametersCallbackHandle::SharedPtr parameters_;
  double pace_ = 1, way_ = 0;  // way_: of the next step
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<CountingServer>(read_options(argc, argv)));
  rclcpp::shutdown();
}
