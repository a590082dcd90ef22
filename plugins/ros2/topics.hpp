// Publishers and subscriptions of leaves.
#pragma once

#include <memory>
#include <string>

#include "graph.hpp"
#include "lines.hpp"
#include "middleware.hpp"
#include "triple_buffer.hpp"
#include "types.hpp"

namespace ros2 {

// "default", "sensor_data" or "latched".
rmw_qos_profile_t qos_named(const std::string& name);

// All functions but lines() are called by the thread of ROS.
class Publisher {
 public:
  Publisher(const MessageType& type, std::string topic, std::string qos);
  ~Publisher();
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  void open();
  void publish(const Message& message);
  Ids receivers() const;
  Lines& lines() { return lines_; }

 private:
  void look_who_receives(Clock::time_point now);

  const MessageType& type_;
  const std::string topic_, qos_;
  rcl_publisher_t publisher_;
  bool is_made_ = false, has_told_ = false;
  Clock::time_point next_look_{};
  Lines lines_;
};

class Subscription final : public Waitable {
 public:
  enum class From { All, Others };  // Others: not from this process
  Subscription(const MessageType& type, std::string topic, std::string qos, From from = From::All);
  ~Subscription() override;

  struct Received {
    Message message;
    Clock::time_point at{};
  };
  // By the leaf.
  TripleBuffer<Received>& received() { return received_; }
  Lines& lines() { return lines_; }

  // By the thread of ROS.
  void open();
  void add_sizes(Sizes& sizes) const override;
  void add_to(rcl_wait_set_t& set) override;
  void take(const rcl_wait_set_t& set) override;
  // Until the first message, looks whether one could come.
  bool poll(Clock::time_point now) override;

 private:
  const MessageType& type_;
  const std::string topic_, qos_;
  const From from_;
  rcl_subscription_t subscription_;
  bool is_made_ = false, is_settled_ = false, has_looked_ = false;
  Clock::time_point next_look_{};
  TripleBuffer<Received> received_;
  Lines lines_;
};

}  // namespace ros2
