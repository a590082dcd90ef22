// Types of actions, services and messages, as introspection knows them.
#pragma once

#include <rosidl_runtime_c/action_type_support_struct.h>
#include <rosidl_runtime_c/message_type_support_struct.h>
#include <rosidl_runtime_c/service_type_support_struct.h>

#include <cstdint>
#include <string>
#include <vector>

#include "fields.hpp"
#include "message.hpp"
#include "result.hpp"
#include "result_words.hpp"

namespace ros2 {

struct ActionType {
  std::string name;
  const rosidl_action_type_support_t* support;
  const Members *send_goal, *goal_response, *get_result, *result_response, *feedback_message;
  // Places in these messages. The id of the goal is the first member of send_goal, get_result and
  // feedback_message.
  std::size_t accepted, status;
  const rosidl_message_type_support_t* goal_message;
  std::size_t goal_in_request;
  std::vector<Field> goal, result, feedback;  // offsets from the whole message that has them
  ResultWords result_words = {};
};

// The same type gives the same pointer, for ever.
Result<const ActionType*> action_type(const std::string& name);

struct ServiceType {
  std::string name;
  const rosidl_service_type_support_t* support;
  const Members *request_message, *response_message;
  std::vector<Field> request, response;
  ResultWords response_words = {};
};
Result<const ServiceType*> service_type(const std::string& name);

struct MessageType {
  std::string name;
  const rosidl_message_type_support_t* support;
  const Members* members;
  std::vector<Field> fields;
};
Result<const MessageType*> message_type(const std::string& name);

}  // namespace ros2
