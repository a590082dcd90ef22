// A lifecycle node for the tests: lifecycle_server NAME [--refuse]. With --refuse it does not get
// active. It prints each transition.
#include <cstdio>
#include <cstring>
#include <memory>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_lifecycle/lifecycle_node.hpp"

namespace {

class Node : public rclcpp_lifecycle::LifecycleNode {
 public:
  Node(const char* name, bool refuses) : LifecycleNode(name), refuses_(refuses) { say("ready"); }

  CallbackReturn on_configure(const rclcpp_lifecycle::State&) override { return done("configure"); }
  CallbackReturn on_activate(const rclcpp_lifecycle::State&) override {
    if (!refuses_) return done("activate");
    say("no");
    return CallbackReturn::FAILURE;
  }
  CallbackReturn on_deactivate(const rclcpp_lifecycle::State&) override {
    return done("deactivate");
  }
  CallbackReturn on_cleanup(const rclcpp_lifecycle::State&) override { return done("cleanup"); }
  CallbackReturn on_shutdown(const rclcpp_lifecycle::State&) override { return done("shutdown"); }

 private:
  static void say(const char* line) {
    std::puts(line);
    std::fflush(stdout);
  }
  static CallbackReturn done(const char* line) {
    say(line);
    return CallbackReturn::SUCCESS;
  }

  const bool refuses_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const bool refuses = argc > 2 && std::strcmp(argv[2], "--refuse") == 0;
  rclcpp::spin(std::make_shared<Node>(argc > 1 ? argv[1] : "lifecycle_server", refuses)
                   ->get_node_base_interface());
  rclcpp::shutdown();
}
