// RosService: any service.
#pragma once

#include <lockstep/leaf.h>

namespace ros2 {

const lockstep_leaf_type& ros_service();

}  // namespace ros2
