#include "time_source.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include "field_values.hpp"
#include "topics.hpp"

namespace ros2 {
namespace {

constexpr std::int64_t kNone = -1;

// What /clock has said last; kNone before.
std::atomic<std::int64_t>& last_time() {
  static std::atomic<std::int64_t> time{kNone};
  return time;
}
std::atomic<bool> is_open{false};

// Takes each message as it comes, so that nobody waits for a tick.
class ClockTopic final : public Waitable {
 public:
  ClockTopic(const MessageType& type, const Field& sec, const Field& nanosec)
      : subscription_(type, "/clock", "sensor_data"), sec_(sec), nanosec_(nanosec) {}

  void open() { subscription_.open(); }
  void add_sizes(Sizes& sizes) const override { subscription_.add_sizes(sizes); }
  void add_to(rcl_wait_set_t& set) override { subscription_.add_to(set); }
  bool poll(Clock::time_point /*now*/) override { return false; }
  void take(const rcl_wait_set_t& set) override {
    subscription_.take(set);
    if (!subscription_.received().update()) return;
    const void* const message = subscription_.received().front().message.get();
    const double sec = *number_in(sec_, message), nanosec = *number_in(nanosec_, message);
    last_time() = std::int64_t(sec) * 1'000'000'000 + std::int64_t(nanosec);
  }

 private:
  Subscription subscription_;
  const Field sec_, nanosec_;
};

bool open(const char** why) {
  static std::string problem;
  auto type = message_type("rosgraph_msgs/msg/Clock");
  if (!type) {
    problem = type.problem().message;
    *why = problem.c_str();
    return false;
  }
  const Field* const sec = find_field((*type)->fields, "clock.sec");
  const Field* const nanosec = find_field((*type)->fields, "clock.nanosec");
  const auto topic = std::make_shared<ClockTopic>(**type, *sec, *nanosec);
  is_open = true;
  Middleware::get().post([topic] {
    topic->open();
    Middleware::get().add(topic);
  });
  return true;
}

std::int64_t now() {
  return last_time().load(std::memory_order_relaxed);
}

}  // namespace

const lockstep_clock& ros_clock() {
  static constexpr lockstep_clock clock{sizeof(lockstep_clock), "ros", open, now};
  return clock;
}

std::int64_t ros_now() {
  if (is_open) return std::max<std::int64_t>(now(), 0);
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
}

}  // namespace ros2
