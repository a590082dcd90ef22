// Requests and answers of the services with which a node reads and sets its parameters.
#pragma once

#include <rcl_interfaces/msg/parameter_value.h>

#include <string>

#include "message.hpp"

namespace ros2 {

using ParameterValue = rcl_interfaces__msg__ParameterValue;

// rcl_interfaces/msg/ParameterType.
enum ParameterKind : std::uint8_t { kNotSet, kBool, kInt, kDouble, kString };

constexpr const char* kGetParameters = "rcl_interfaces/srv/GetParameters";
constexpr const char* kSetParameters = "rcl_interfaces/srv/SetParameters";

bool put(rosidl_runtime_c__String& into, const std::string& text);

// For one parameter. False, null: there is no memory.
bool ask_for_parameter(Message& request, const std::string& name);
ParameterValue* value_to_set(Message& request, const std::string& name);

// Null: the node has no such parameter.
const ParameterValue* value_in(const Message& response);
// "" or why it was not set.
std::string why_not_set(const Message& response);

}  // namespace ros2
