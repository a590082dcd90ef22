// An action server of example_interfaces/action/Fibonacci for the tests: it counts to `order`, one
// step each `--step` ms, and tells of each step. What it does besides is said by options:
//   --keep       a goal goes on where the one before it stopped, as a robot that has a position
//   --reject     takes no goal          --abort N   aborts at the step N
//   --refuse     refuses to cancel      --die N     kills itself at the step N
//   --quit N     lets somebody else cancel the goal at the step N
//   --preempt    a goal aborts the one before it, as one of Nav2 does
//   --reject-order N: takes no goal with this order
//   --accept-after N: answers a goal after N ms
//   --hold-service NAME, --hold-topic NAME: stands while it is true
// It prints one line for each thing that happens to it.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "example_interfaces/action/fibonacci.hpp"
#include "example_interfaces/srv/set_bool.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_action/rclcpp_action.hpp"
#include "std_msgs/msg/bool.hpp"

namespace {

using Fibonacci = example_interfaces::action::Fibonacci;
using GoalHandle = rclcpp_action::ServerGoalHandle<Fibonacci>;
using SetBool = example_interfaces::srv::SetBool;

struct Options {
  std::string node = "counting_server_" + std::to_string(getpid());
  std::string action = "/count", hold_service, hold_topic;
  int step = 20, abort_at = -1, die_at = -1, quit_at = -1, reject_order = -1, accept_after = 0;
  bool keeps = false, rejects = false, refuses = false, preempts = false;
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
    if (word == "--step") options.step = number();
    if (word == "--abort") options.abort_at = number();
    if (word == "--die") options.die_at = number();
    if (word == "--quit") options.quit_at = number();
    if (word == "--reject-order") options.reject_order = number();
    if (word == "--accept-after") options.accept_after = number();
    if (word == "--preempt") options.preempts = true;
    if (word == "--keep") options.keeps = true;
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
    declare_parameter("speed", 0.5);
    declare_parameter("label", "slow");
    say("ready");
  }
  // The handle of a goal that is open throws in its destructor when ROS has shut down.
  ~CountingServer() override { new std::vector<Goal>(std::move(goals_)); }

 private:
  void hold(bool held) {
    held_ = held;
    say(held ? "hold" : "go on");
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
    goals_.push_back({std::move(handle), options_.keeps ? kept_ : 0});
  }

  void step() {
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
    if (held_) return false;
    ++goal.count;
    result->sequence = counted(goal);
    auto feedback = std::make_shared<Fibonacci::Feedback>();
    feedback->sequence = result->sequence;
    goal.handle->publish_feedback(feedback);
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
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<CountingServer>(read_options(argc, argv)));
  rclcpp::shutdown();
}
