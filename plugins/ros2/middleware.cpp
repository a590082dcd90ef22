#include "middleware.hpp"

#include <rcl/error_handling.h>
#include <rcl/graph.h>
#include <rcutils/logging.h>
#include <unistd.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <sstream>

namespace ros2 {
namespace {

// --ros-args -r __ns:=/left: remapping, as on the command line of a node.
std::vector<std::string> arguments() {
  std::vector<std::string> all{"lockstep"};
  const char* const given = std::getenv("LOCKSTEP_ROS_ARGS");
  if (given == nullptr) return all;
  all.emplace_back("--ros-args");
  std::istringstream words(given);
  for (std::string word; words >> word;) {
    if (word != "--ros-args") all.push_back(word);
  }
  return all;
}

std::string open_context(rcl_context_t& context) {
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  if (rcl_init_options_init(&options, rcl_get_default_allocator()) != RCL_RET_OK) {
    return last_ros_error();
  }
  const std::vector<std::string> texts = arguments();
  std::vector<const char*> argv;
  for (const std::string& text : texts) argv.push_back(text.c_str());
  context = rcl_get_zero_initialized_context();
  const auto code = rcl_init(static_cast<int>(argv.size()), argv.data(), &options, &context);
  std::string problem = code == RCL_RET_OK ? "" : last_ros_error();
  if (rcl_init_options_fini(&options) != RCL_RET_OK) rcl_reset_error();
  return problem;
}

}  // namespace

std::string last_ros_error() {
  std::string text = rcl_get_error_string().str;
  rcl_reset_error();
  const auto place = text.find(", at /");
  return place == std::string::npos ? text : text.substr(0, place);
}

Middleware& Middleware::get() {
  // Never destroyed: rmw may log until the process ends.
  static auto& only = *new Middleware;
  return only;
}

std::string Middleware::start() {
  std::promise<std::string> opened;
  auto problem = opened.get_future();
  is_over_ = false;
  thread_ = std::thread([this, &opened] {
    std::string why = open();
    const bool works = why.empty();
    opened.set_value(std::move(why));
    if (!works) return;
    loop();
    close();
  });
  std::string why = problem.get();
  if (!why.empty()) thread_.join();
  return why;
}

void Middleware::stop() {
  if (!thread_.joinable()) return;
  post([this] { is_over_ = true; });
  thread_.join();
}

std::string Middleware::open() {
  // A program that embeds lockstep and uses ROS has its own handler, which stays.
  const bool is_free =
      rcutils_logging_initialize() == RCUTILS_RET_OK &&
      rcutils_logging_get_output_handler() == rcutils_logging_console_output_handler;
  if (is_free) rcutils_logging_set_output_handler(keep_log_line);
  if (std::string why = open_context(context_); !why.empty()) return why;
  rcl_node_options_t options = rcl_node_get_default_options();
  options.enable_rosout = false;
  node_ = rcl_get_zero_initialized_node();
  const std::string name = "lockstep_" + std::to_string(getpid());
  set_ = rcl_get_zero_initialized_wait_set();
  posted_ = rcl_get_zero_initialized_guard_condition();
  const bool works =
      rcl_node_init(&node_, name.c_str(), "", &context_, &options) == RCL_RET_OK &&
      rcl_guard_condition_init(&posted_, &context_, rcl_guard_condition_get_default_options()) ==
          RCL_RET_OK &&
      rcl_wait_set_init(&set_, 0, 2, 0, 0, 0, 0, &context_, rcl_get_default_allocator()) ==
          RCL_RET_OK;
  if (rcl_node_options_fini(&options) != RCL_RET_OK) rcl_reset_error();
  if (works) return {};
  std::string why = last_ros_error();
  close();
  return why;
}

void Middleware::close() {
  waitables_.clear();
  if (rcl_wait_set_is_valid(&set_) && rcl_wait_set_fini(&set_) != RCL_RET_OK) rcl_reset_error();
  {
    const std::lock_guard lock(trigger_);
    if (rcl_guard_condition_fini(&posted_) != RCL_RET_OK) rcl_reset_error();
    posted_ = rcl_get_zero_initialized_guard_condition();
  }
  if (rcl_node_is_valid(&node_) && rcl_node_fini(&node_) != RCL_RET_OK) rcl_reset_error();
  if (rcl_shutdown(&context_) != RCL_RET_OK) rcl_reset_error();
  if (rcl_context_fini(&context_) != RCL_RET_OK) rcl_reset_error();
  rcl_reset_error();
}

void Middleware::post(std::function<void()> work) {
  auto* const item = new Work{work_.load(std::memory_order_relaxed), std::move(work)};
  while (!work_.compare_exchange_weak(item->next, item, std::memory_order_release)) {
  }
  const std::lock_guard lock(trigger_);
  if (posted_.impl != nullptr && rcl_trigger_guard_condition(&posted_) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

void Middleware::do_posted() {
  Work* last = work_.exchange(nullptr, std::memory_order_acquire);
  Work* first = nullptr;
  while (last != nullptr) {
    Work* const next = last->next;
    last->next = first;
    first = last;
    last = next;
  }
  while (first != nullptr) {
    const std::unique_ptr<Work> item(first);
    first = first->next;
    item->run();
  }
}

void Middleware::loop() {
  while (true) {
    do_posted();
    if (is_over_) return;
    bool is_eager = false;
    const auto now = Clock::now();
    for (const auto& it : waitables_) is_eager |= it->poll(now);
    wait(std::chrono::milliseconds(is_eager ? 20 : 1000));
  }
}

void Middleware::wait(std::chrono::milliseconds most) {
  Waitable::Sizes sizes;
  for (const auto& it : waitables_) it->add_sizes(sizes);
  const rcl_guard_condition_t* const graph = rcl_node_get_graph_guard_condition(&node_);
  std::size_t index = 0;
  const bool is_ready =
      rcl_wait_set_resize(&set_, sizes.subscriptions, sizes.guards + 2, sizes.timers, sizes.clients,
                          sizes.services, 0) == RCL_RET_OK &&
      rcl_wait_set_clear(&set_) == RCL_RET_OK &&
      rcl_wait_set_add_guard_condition(&set_, &posted_, &index) == RCL_RET_OK &&
      rcl_wait_set_add_guard_condition(&set_, graph, &index) == RCL_RET_OK;
  if (!is_ready) {
    rcl_reset_error();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return;
  }
  for (const auto& it : waitables_) it->add_to(set_);
  const auto code = rcl_wait(&set_, std::chrono::nanoseconds(most).count());
  if (code != RCL_RET_OK) {
    rcl_reset_error();
    return;
  }
  // An answer may make or remove others.
  const auto all = waitables_;
  for (const auto& it : all) it->take(set_);
}

void Middleware::add(std::shared_ptr<Waitable> waitable) {
  waitables_.push_back(std::move(waitable));
}

void Middleware::remove(const Waitable* waitable) {
  waitables_.erase(std::remove_if(waitables_.begin(), waitables_.end(),
                                  [&](const auto& it) { return it.get() == waitable; }),
                   waitables_.end());
}

void Middleware::keep_log_line(const rcutils_log_location_t* /*place*/, int severity,
                               const char* name, rcutils_time_point_value_t /*time*/,
                               const char* format, va_list* arguments) {
  if (severity < RCUTILS_LOG_SEVERITY_WARN) return;
  char text[512];
  va_list copy;
  va_copy(copy, *arguments);
  std::vsnprintf(text, sizeof text, format, copy);
  va_end(copy);
  get().log_.add(std::string(name) + ": " + text);
}

}  // namespace ros2
