// The node of this process, and the one thread that makes all calls of ROS.
#pragma once

#include <lockstep/duration.h>
#include <rcl/rcl.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "lines.hpp"

namespace ros2 {

using Clock = std::chrono::steady_clock;

// The thread waits for these. It calls all functions.
class Waitable {
 public:
  virtual ~Waitable() = default;
  struct Sizes {
    std::size_t subscriptions = 0, guards = 0, timers = 0, clients = 0, services = 0;
  };
  virtual void add_sizes(Sizes& sizes) const = 0;
  virtual void add_to(rcl_wait_set_t& set) = 0;
  virtual void take(const rcl_wait_set_t& set) = 0;
  // Does what time alone asks for. Returns whether it is to be called again within 20 ms.
  virtual bool poll(Clock::time_point now) = 0;
};

class Middleware {
 public:
  static Middleware& get();

  // "" or why there is no node.
  std::string start();
  void stop();

  // From any thread; never waits for ROS. The thread calls `work` soon, in the order of the posts.
  void post(std::function<void()> work);

  // By the thread only.
  rcl_node_t& node() { return node_; }
  rcl_context_t& context() { return context_; }
  void add(std::shared_ptr<Waitable> waitable);
  void remove(const Waitable* waitable);

  // The next line that ROS itself has logged, for any thread; false: there is none.
  bool next_log_line(std::string& line) { return log_.next(line); }

 private:
  struct Work {
    Work* next;
    std::function<void()> run;
  };

  std::string open();
  void close();
  void loop();
  void do_posted();
  void wait(std::chrono::milliseconds most);
  static void keep_log_line(const rcutils_log_location_t*, int severity, const char* name,
                            rcutils_time_point_value_t, const char* format, va_list* arguments);

  rcl_context_t context_{};
  rcl_node_t node_{};
  rcl_wait_set_t set_{};
  rcl_guard_condition_t posted_{};
  std::mutex trigger_;  // a guard condition is triggered by one thread at a time
  std::atomic<Work*> work_{nullptr};
  std::atomic<bool> is_over_{false};
  std::vector<std::shared_ptr<Waitable>> waitables_;
  std::thread thread_;
  Lines log_;
};

// Takes the message of the last failure of ROS, which is forgotten then.
std::string last_ros_error();

}  // namespace ros2
