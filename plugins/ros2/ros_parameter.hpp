// RosParameter: a parameter of any node.
#pragma once

#include <lockstep/leaf.h>

namespace ros2 {

const lockstep_leaf_type& ros_parameter();

}  // namespace ros2
