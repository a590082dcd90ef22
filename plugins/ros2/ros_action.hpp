// RosAction: any action of any server.
#pragma once

#include <lockstep/leaf.h>

namespace ros2 {

const lockstep_leaf_type& ros_action();

}  // namespace ros2
