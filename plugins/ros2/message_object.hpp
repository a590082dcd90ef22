// A message as an object that entries carry: goal.pose="{pose}".
#pragma once

#include <lockstep/leaf.h>

#include "message.hpp"

namespace ros2 {

// The type of a message's objects, "ros2:geometry_msgs/msg/PoseStamped", made once.
const lockstep_object_type& object_type(const Members& members);

// A copy, with one reference.
void* make_object(const Members& members, const void* message);
void release_object(void* object);
// False: there is no memory.
bool copy_object(const Members& members, void* message, const void* object);

}  // namespace ros2
