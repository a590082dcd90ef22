// Publishes /clock: clock_publisher PART..., one after the other, each FROM:TO:SPEED in seconds of
// simulated time, or stand:SECONDS of real time. It begins when somebody listens, and at the end it
// stands. It prints each part that begins.
#include <chrono>
#include <cstdio>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <rosgraph_msgs/msg/clock.hpp>
#include <thread>

namespace {

using namespace std::chrono_literals;
using Message = rosgraph_msgs::msg::Clock;

class Publisher {
 public:
  Publisher() : node_(std::make_shared<rclcpp::Node>("clock_publisher")) {
    publisher_ = node_->create_publisher<Message>("/clock", rclcpp::ClockQoS());
    say("ready");
    while (rclcpp::ok() && publisher_->get_subscription_count() == 0) wait();
  }

  void play(const char* part) {
    say(part);
    double from = 0, to = 0, speed = 1;
    if (std::sscanf(part, "stand:%lf", &to) == 1) {
      for (double t = 0; t < to && rclcpp::ok(); t += kPeriod) wait();
    } else if (std::sscanf(part, "%lf:%lf:%lf", &from, &to, &speed) == 3) {
      for (double t = from; t < to && rclcpp::ok(); t += kPeriod * speed) publish(t);
      publish(to);
    }
  }
  void stand() {
    say("stands");
    while (rclcpp::ok()) wait();
  }

 private:
  static constexpr double kPeriod = 0.005;

  static void say(const char* line) {
    std::puts(line);
    std::fflush(stdout);
  }
  static void wait() { std::this_thread::sleep_for(5ms); }
  void publish(double seconds) {
    Message message;
    message.clock = rclcpp::Time(static_cast<std::int64_t>(seconds * 1e9));
    publisher_->publish(message);
    wait();
  }

  std::shared_ptr<rclcpp::Node> node_;
  rclcpp::Publisher<Message>::SharedPtr publisher_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  Publisher publisher;
  for (int i = 1; i < argc; ++i) publisher.play(argv[i]);
  publisher.stand();
  rclcpp::shutdown();
}
