// RosPublish and RosReceive: any topic.
#pragma once

#include <lockstep/leaf.h>

namespace ros2 {

const lockstep_leaf_type& ros_publish();
const lockstep_leaf_type& ros_receive();

}  // namespace ros2
