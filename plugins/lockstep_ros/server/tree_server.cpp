#include "tree_server.hpp"

#include <chrono>
#include <filesystem>

namespace lockstep_ros {
namespace {

using rclcpp::ParameterType;

// It has any type until it is read: people write 100 for 100.0.
void declare_number(rclcpp::Node& node, const char* name, double value) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.dynamic_typing = true;
  node.declare_parameter(name, rclcpp::ParameterValue(value), descriptor);
}

double number_above_0(const rclcpp::Parameter& parameter) {
  const bool is_whole = parameter.get_type() == ParameterType::PARAMETER_INTEGER;
  const bool is_double = parameter.get_type() == ParameterType::PARAMETER_DOUBLE;
  const double value = is_whole    ? static_cast<double>(parameter.as_int())
                       : is_double ? parameter.as_double()
                                   : 0;
  if (value > 0) return value;
  throw lockstep::runtime::Error("the parameter '" + parameter.get_name() + "' is " +
                                 parameter.value_to_string() + ", expected a number above 0");
}

}  // namespace

using namespace std::chrono_literals;
using diagnostic_msgs::msg::DiagnosticStatus;

TreeServer::TreeServer() : Node("tree_server") {
  declare_parameter("trees", ".");
  declare_parameter("plugin_path", std::vector<std::string>{});
  declare_number(*this, "rate", 100);
  declare_number(*this, "feedback_period", 0.1);
  if (const std::string trees = settings().trees; !std::filesystem::is_directory(trees)) {
    RCLCPP_WARN(get_logger(), "the parameter 'trees': there is no directory '%s'", trees.c_str());
  }
  states_ = create_publisher<msg::TreeState>("~/state", rclcpp::QoS(1).transient_local());
  diagnostics_ = create_publisher<diagnostic_msgs::msg::DiagnosticArray>("/diagnostics", 1);
  timer_ = create_wall_timer(1s, [this] { diagnose(); });
  server_ = rclcpp_action::create_server<RunTree>(
      this, "run_tree",
      [this](const rclcpp_action::GoalUUID&, std::shared_ptr<const RunTree::Goal> goal) {
        return look_at(*goal);
      },
      [](std::shared_ptr<GoalHandle>) { return rclcpp_action::CancelResponse::ACCEPT; },
      [this](std::shared_ptr<GoalHandle> handle) { begin(std::move(handle)); });
}

TreeServer::~TreeServer() {
  is_ending_ = true;
  if (thread_.joinable()) thread_.join();
}

TreeSettings TreeServer::settings() {
  TreeSettings settings;
  settings.trees = get_parameter("trees").as_string();
  settings.plugin_path = get_parameter("plugin_path").as_string_array();
  settings.period = 1 / number_above_0(get_parameter("rate"));
  settings.told_each = number_above_0(get_parameter("feedback_period"));
  settings.log = [logger = get_logger()](const std::string& who, lockstep::LogLevel level,
                                         const std::string& text) {
    if (level == lockstep::LogLevel::Warning) {
      RCLCPP_WARN(logger, "%s: %s", who.c_str(), text.c_str());
    } else {
      RCLCPP_INFO(logger, "%s: %s", who.c_str(), text.c_str());
    }
  };
  return settings;
}

rclcpp_action::GoalResponse TreeServer::look_at(const RunTree::Goal& goal) {
  if (is_busy_.exchange(true)) {
    RCLCPP_WARN(get_logger(), "'%s' is rejected: a tree runs already", goal.tree.c_str());
    return rclcpp_action::GoalResponse::REJECT;
  }
  return rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE;
}

void TreeServer::begin(std::shared_ptr<GoalHandle> handle) {
  if (thread_.joinable()) thread_.join();
  thread_ = std::thread([this, handle = std::move(handle)] { run(handle); });
}

void TreeServer::run(const std::shared_ptr<GoalHandle>& handle) {
  const auto result = std::make_shared<RunTree::Result>();
  try {
    *result = run_tree(*handle);
  } catch (const lockstep::runtime::Error& error) {
    result->status = "invalid";
    result->reason = error.what();
  }
  RCLCPP_INFO(get_logger(), "'%s': %s%s%s", handle->get_goal()->tree.c_str(),
              result->status.c_str(), result->reason.empty() ? "" : ", ", result->reason.c_str());
  end(*handle->get_goal(), *result);
  is_busy_ = false;
  if (!rclcpp::ok()) return;
  if (result->status == "success") return handle->succeed(result);
  if (handle->is_canceling()) return handle->canceled(result);
  handle->abort(result);
}

TreeServer::RunTree::Result TreeServer::run_tree(GoalHandle& handle) {
  TreeRun run(*handle.get_goal(), settings());
  last_project_ = run.project();
  const auto tell_of = [&](const msg::TreeState& state) { tell(handle, state); };
  if (!get_parameter("use_sim_time").as_bool()) {
    return run.loop([&] { return is_stopped(handle); }, tell_of);
  }
  while (now().nanoseconds() == 0 && !is_stopped(handle)) std::this_thread::sleep_for(5ms);
  rclcpp::Time last = now();
  double passed = 0;
  return run.loop([&](double time) { return wait_for(time, last, passed, handle); }, tell_of);
}

bool TreeServer::is_stopped(const GoalHandle& handle) const {
  return is_ending_ || !rclcpp::ok() || handle.is_canceling();
}

// In simulated time: until the clock has come to `time`. While it stands, nothing is ticked; after
// it was reset, the run goes on from where it was.
double TreeServer::wait_for(double time, rclcpp::Time& last, double& passed,
                            const GoalHandle& handle) {
  while (!is_stopped(handle)) {
    const rclcpp::Time there = now();
    if (there > last) passed += (there - last).seconds();
    last = there;
    if (passed >= time) return passed;
    std::this_thread::sleep_for(1ms);
  }
  return -1;
}

void TreeServer::tell(GoalHandle& handle, msg::TreeState state) {
  state.stamp = now();
  states_->publish(state);
  const auto feedback = std::make_shared<RunTree::Feedback>();
  feedback->state = state;
  if (rclcpp::ok() && handle.is_active()) handle.publish_feedback(feedback);
  const std::lock_guard lock(mutex_);
  last_ = std::move(state);
}

// Who looks at the topic later sees how the last tree has ended.
void TreeServer::end(const RunTree::Goal& goal, const RunTree::Result& result) {
  const std::lock_guard lock(mutex_);
  ended_ = result;
  last_.stamp = now();
  last_.tree = goal.tree;
  last_.status = result.status;
  last_.running.clear();
  last_.held.clear();
  states_->publish(last_);
}

void TreeServer::diagnose() {
  diagnostic_msgs::msg::DiagnosticArray all;
  all.header.stamp = now();
  auto& status = all.status.emplace_back();
  const auto add = [&](const char* key, const std::string& value) {
    auto& pair = status.values.emplace_back();
    pair.key = key;
    pair.value = value;
  };
  status.name = std::string(get_name()) + ": tree";
  status.hardware_id = "none";
  const std::lock_guard lock(mutex_);
  const bool has_failed = !is_busy_ && !ended_.status.empty() && ended_.status != "success" &&
                          ended_.status != "halted";
  status.level = has_failed ? DiagnosticStatus::ERROR : DiagnosticStatus::OK;
  status.message = is_busy_ ? "running" : ended_.status.empty() ? "no tree has run" : ended_.status;
  if (!is_busy_ && !ended_.reason.empty()) status.message += ": " + ended_.reason;
  add("tree", last_.tree);
  add("ticks", std::to_string(last_.tick));
  add("progress", std::to_string(last_.progress));
  for (const auto& it : last_.running) add("running", it.path);
  for (const auto& it : last_.held) add("held", it.path + " by " + it.by);
  diagnostics_->publish(all);
}

}  // namespace lockstep_ros
