#include "types.hpp"

#include <rosidl_typesupport_introspection_c/identifier.h>
#include <rosidl_typesupport_introspection_c/service_introspection.h>

#include <map>
#include <memory>
#include <mutex>

#include "package_index.hpp"

namespace ros2 {
namespace {

using ServiceMembers = rosidl_typesupport_introspection_c__ServiceMembers;

const Members* members_of_message(const rosidl_message_type_support_t* support) {
  const auto* const found =
      get_message_typesupport_handle(support, rosidl_typesupport_introspection_c__identifier);
  return found == nullptr ? nullptr : static_cast<const Members*>(found->data);
}

const ServiceMembers* members_of_service(const rosidl_service_type_support_t* support) {
  const auto* const found =
      get_service_typesupport_handle(support, rosidl_typesupport_introspection_c__identifier);
  return found == nullptr ? nullptr : static_cast<const ServiceMembers*>(found->data);
}

std::vector<Field> fields_in(const Members& message, const char* part) {
  const Member& member = member_named(message, part);
  return fields_of(members_of(member), member.offset_);
}

Problem no_introspection(const std::string& name) {
  return {"'" + name + "' has no introspection",
          "build its package with rosidl_typesupport_introspection_c"};
}

Result<const ActionType*> make_action_type(const std::string& name) {
  auto parsed = parse_type_name(name, "action");
  if (!parsed) return parsed.problem();
  auto support = type_support(*parsed);
  if (!support) return support.problem();
  auto goal_message = goal_support(*parsed);
  if (!goal_message) return goal_message.problem();
  auto type = std::make_unique<ActionType>();
  type->name = name;
  type->support = static_cast<const rosidl_action_type_support_t*>(*support);
  const ServiceMembers* const goal = members_of_service(type->support->goal_service_type_support);
  const ServiceMembers* const result =
      members_of_service(type->support->result_service_type_support);
  type->feedback_message = members_of_message(type->support->feedback_message_type_support);
  if (goal == nullptr || result == nullptr || type->feedback_message == nullptr) {
    return no_introspection(name);
  }
  type->send_goal = goal->request_members_;
  type->goal_response = goal->response_members_;
  type->get_result = result->request_members_;
  type->result_response = result->response_members_;
  type->goal_message = static_cast<const rosidl_message_type_support_t*>(*goal_message);
  type->goal_in_request = member_named(*type->send_goal, "goal").offset_;
  type->accepted = member_named(*type->goal_response, "accepted").offset_;
  type->status = member_named(*type->result_response, "status").offset_;
  type->goal = fields_in(*type->send_goal, "goal");
  type->result = fields_in(*type->result_response, "result");
  type->feedback = fields_in(*type->feedback_message, "feedback");
  type->result_words =
      ResultWords(members_of(member_named(*type->result_response, "result")), type->result);
  return static_cast<const ActionType*>(type.release());
}

Result<const ServiceType*> make_service_type(const std::string& name) {
  auto parsed = parse_type_name(name, "srv");
  if (!parsed) return parsed.problem();
  auto found = type_support(*parsed);
  if (!found) return found.problem();
  const auto* const support = static_cast<const rosidl_service_type_support_t*>(*found);
  const ServiceMembers* const members = members_of_service(support);
  if (members == nullptr) return no_introspection(name);
  auto* const type = new ServiceType{name,
                                     support,
                                     members->request_members_,
                                     members->response_members_,
                                     fields_of(*members->request_members_),
                                     fields_of(*members->response_members_)};
  type->response_words = ResultWords(*type->response_message, type->response);
  return static_cast<const ServiceType*>(type);
}

Result<const MessageType*> make_message_type(const std::string& name) {
  auto parsed = parse_type_name(name, "msg");
  if (!parsed) return parsed.problem();
  auto found = type_support(*parsed);
  if (!found) return found.problem();
  const auto* const support = static_cast<const rosidl_message_type_support_t*>(*found);
  const Members* const members = members_of_message(support);
  if (members == nullptr) return no_introspection(name);
  return static_cast<const MessageType*>(
      new MessageType{name, support, members, fields_of(*members)});
}

// Types stay for ever. Failures are not kept: a package may be installed while an editor runs.
template <class T, class Make>
Result<const T*> kept(const std::string& key, Make make) {
  static std::mutex mutex;
  static auto& all = *new std::map<std::string, const T*>;
  const std::lock_guard lock(mutex);
  const auto known = all.find(key);
  if (known != all.end()) return known->second;
  auto made = make();
  if (made) all.emplace(key, *made);
  return made;
}

}  // namespace

Result<const ActionType*> action_type(const std::string& name) {
  return kept<ActionType>(name, [&] { return make_action_type(name); });
}

Result<const ServiceType*> service_type(const std::string& name) {
  return kept<ServiceType>(name, [&] { return make_service_type(name); });
}

Result<const MessageType*> message_type(const std::string& name) {
  return kept<MessageType>(name, [&] { return make_message_type(name); });
}

}  // namespace ros2
