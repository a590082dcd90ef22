#include "parameter.hpp"

#include <rcl_interfaces/msg/parameter.h>
#include <rcl_interfaces/srv/get_parameters.h>
#include <rcl_interfaces/srv/set_parameters.h>
#include <rosidl_runtime_c/string_functions.h>

namespace ros2 {

bool put(rosidl_runtime_c__String& into, const std::string& text) {
  return rosidl_runtime_c__String__assignn(&into, text.data(), text.size());
}

bool ask_for_parameter(Message& request, const std::string& name) {
  auto& names = request.at<rcl_interfaces__srv__GetParameters_Request>(0)->names;
  return rosidl_runtime_c__String__Sequence__init(&names, 1) && put(names.data[0], name);
}

ParameterValue* value_to_set(Message& request, const std::string& name) {
  auto& parameters = request.at<rcl_interfaces__srv__SetParameters_Request>(0)->parameters;
  const bool is_made = rcl_interfaces__msg__Parameter__Sequence__init(&parameters, 1) &&
                       put(parameters.data[0].name, name);
  return is_made ? &parameters.data[0].value : nullptr;
}

const ParameterValue* value_in(const Message& response) {
  const auto& values =
      static_cast<const rcl_interfaces__srv__GetParameters_Response*>(response.get())->values;
  // Nodes answer in one of two ways when there is no such parameter.
  return values.size == 1 && values.data[0].type != kNotSet ? &values.data[0] : nullptr;
}

std::string why_not_set(const Message& response) {
  const auto& results =
      static_cast<const rcl_interfaces__srv__SetParameters_Response*>(response.get())->results;
  if (results.size != 1) return "no answer";
  const auto& result = results.data[0];
  if (result.successful) return {};
  return result.reason.size == 0 ? "refused" : result.reason.data;
}

}  // namespace ros2
