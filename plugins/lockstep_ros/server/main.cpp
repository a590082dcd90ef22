// The program tree_server: ros2 run lockstep_ros tree_server --ros-args -p trees:=DIRECTORY
#include <memory>

#include "tree_server.hpp"

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<lockstep_ros::TreeServer>());
  rclcpp::shutdown();
}
