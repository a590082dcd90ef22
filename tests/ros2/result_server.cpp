// An action server that aborts each goal with a given result, and a service that refuses, for the
// tests of reasons.
//   --action NAME, --type fetch|plan, --code N, --text T
//   --service NAME: a Trigger that answers false with the text
#include <cstdio>
#include <cstdlib>
#include <example_interfaces/srv/trigger.hpp>
#include <lockstep_ros2_test_interfaces/action/fetch.hpp>
#include <lockstep_ros2_test_interfaces/action/plan.hpp>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_action/rclcpp_action.hpp>
#include <string>

namespace {

using example_interfaces::srv::Trigger;
using lockstep_ros2_test_interfaces::action::Fetch;
using lockstep_ros2_test_interfaces::action::Plan;

struct Options {
  std::string action, type = "fetch", text, service;
  int code = 0;
};

void fill(Fetch::Result& result, const Options& options) {
  result.error_code = static_cast<std::uint16_t>(options.code);
  result.error_msg = options.text;
}
void fill(Plan::Result& result, const Options& options) {
  result.error_code.val = options.code;
}

class ResultServer : public rclcpp::Node {
 public:
  explicit ResultServer(Options options)
      : Node("result_server_" + std::to_string(getpid())), options_(std::move(options)) {
    if (!options_.service.empty()) {
      service_ = create_service<Trigger>(
          options_.service, [this](Trigger::Request::SharedPtr, Trigger::Response::SharedPtr out) {
            out->message = options_.text;
          });
    }
    if (options_.action.empty()) return;
    if (options_.type == "fetch") serve<Fetch>();
    if (options_.type == "plan") serve<Plan>();
  }

 private:
  template <class Action>
  void serve() {
    using Handle = std::shared_ptr<rclcpp_action::ServerGoalHandle<Action>>;
    server_ = rclcpp_action::create_server<Action>(
        this, options_.action,
        [](const rclcpp_action::GoalUUID&, std::shared_ptr<const typename Action::Goal>) {
          return rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE;
        },
        [](Handle) { return rclcpp_action::CancelResponse::ACCEPT; },
        [this](Handle goal) {
          auto result = std::make_shared<typename Action::Result>();
          fill(*result, options_);
          goal->abort(result);
        });
  }

  const Options options_;
  std::shared_ptr<void> server_;
  rclcpp::Service<Trigger>::SharedPtr service_;
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i], value = argv[i + 1];
    if (word == "--action") options.action = value;
    if (word == "--type") options.type = value;
    if (word == "--code") options.code = std::atoi(value.c_str());
    if (word == "--text") options.text = value;
    if (word == "--service") options.service = value;
  }
  rclcpp::init(1, argv);
  const auto server = std::make_shared<ResultServer>(std::move(options));
  std::puts("ready");
  std::fflush(stdout);
  rclcpp::spin(server);
  rclcpp::shutdown();
}
