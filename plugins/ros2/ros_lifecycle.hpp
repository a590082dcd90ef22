#pragma once

#include <lockstep/leaf.h>

namespace ros2 {

// Changes the state of a lifecycle node.
const lockstep_leaf_type& ros_lifecycle();

}  // namespace ros2
