// The calls of one leaf, one at a time, of one service.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "graph.hpp"
#include "lines.hpp"
#include "middleware.hpp"
#include "types.hpp"

namespace ros2 {

class ServiceClient final : public Waitable {
 public:
  enum class Outcome : std::uint8_t { Open, Answered, NoService, NoAnswer, Failed };

  ServiceClient(const ServiceType& type, std::string service);
  ~ServiceClient() override;

  // By the leaf. Activations are numbered, from 1.
  struct Call {
    std::uint64_t activation = 0;
    std::shared_ptr<Message> request = {};
    double timeout = 0;
  };
  Outcome outcome(std::uint64_t activation) const;
  // Whether the request of the activation has been sent to a service.
  bool is_sent(std::uint64_t activation) const { return sent_.load() == activation; }
  const Message& response() const { return *response_; }  // once it is Answered
  Lines& lines() { return lines_; }

  // By the thread of ROS.
  void open();
  bool has_service();
  Ids servers();  // not empty, if there is a service
  void send(Call call);
  // Its answer is not taken any more.
  void forget(std::uint64_t activation);

  void add_sizes(Sizes& sizes) const override;
  void add_to(rcl_wait_set_t& set) override;
  void take(const rcl_wait_set_t& set) override;
  bool poll(Clock::time_point now) override;

 private:
  void end(Outcome outcome);

  const ServiceType& type_;
  const std::string service_;
  rcl_client_t client_;
  std::string why_not_made_;
  bool has_told_ = false;  // which other services there are
  bool is_made_ = false, is_open_ = false, is_sent_ = false;
  Call call_;
  std::int64_t number_ = 0;
  Clock::time_point deadline_;
  std::unique_ptr<Message> response_, next_response_;
  std::atomic<std::uint64_t> ended_{0};  // the activation, and its outcome in the last 8 bits
  std::atomic<std::uint64_t> sent_{0};
  Lines lines_;
};

// "no service", "no answer".
const char* words_of(ServiceClient::Outcome outcome);

}  // namespace ros2
