// The program tree_server: ros2 run lockstep_ros tree_server --ros-args -p trees:=DIRECTORY
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <thread>

#include "tree_server.hpp"

namespace {

// Whoever waits for a result gets it before ROS is shut down. A second signal ends the program at
// once.
void wait_for_signal(rclcpp::Executor& executor, const sigset_t& signals) {
  int number = 0;
  sigwait(&signals, &number);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  executor.cancel();
  while (true) pause();
}

// Null after it has said what is wrong with a parameter.
std::shared_ptr<lockstep_ros::TreeServer> make_server() {
  try {
    return std::make_shared<lockstep_ros::TreeServer>();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tree_server: %s\n", error.what());
    return nullptr;
  }
}

}  // namespace

int main(int argc, char** argv) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // also in all threads that follow
  rclcpp::init(argc, argv, rclcpp::InitOptions(), rclcpp::SignalHandlerOptions::None);
  {
    const auto server = make_server();
    if (server == nullptr) return 2;
    // The thread goes on until the process ends, so what it uses stays.
    static rclcpp::executors::SingleThreadedExecutor executor;
    std::thread([&] { wait_for_signal(executor, signals); }).detach();
    executor.add_node(server);
    executor.spin();
    executor.remove_node(server);
  }
  rclcpp::shutdown();
}
