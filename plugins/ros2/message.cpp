#include "message.hpp"

#include <rcutils/error_handling.h>
#include <rmw/rmw.h>
#include <rosidl_runtime_c/string_functions.h>
#include <rosidl_runtime_c/u16string_functions.h>
#include <rosidl_typesupport_introspection_c/field_types.h>

#include <cstring>
#include <stdexcept>
#include <string>

namespace ros2 {

const Member& member_named(const Members& members, const char* name) {
  for (std::uint32_t i = 0; i < members.member_count_; ++i) {
    if (std::strcmp(members.members_[i].name_, name) == 0) return members.members_[i];
  }
  throw std::logic_error(std::string("no member ") + name + " in " + members.message_name_);
}

const Members& members_of(const Member& member) {
  return *static_cast<const Members*>(member.members_->data);
}

namespace {

std::size_t size_of(std::uint8_t type) {
  switch (type) {
    case rosidl_typesupport_introspection_c__ROS_TYPE_LONG_DOUBLE:
      return sizeof(long double);
    case rosidl_typesupport_introspection_c__ROS_TYPE_DOUBLE:
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT64:
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT64:
      return 8;
    case rosidl_typesupport_introspection_c__ROS_TYPE_FLOAT:
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT32:
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT32:
      return 4;
    case rosidl_typesupport_introspection_c__ROS_TYPE_WCHAR:
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT16:
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT16:
      return 2;
    default:
      return 1;
  }
}

bool copy_item(const Member& member, void* to, const void* from) {
  switch (member.type_id_) {
    case rosidl_typesupport_introspection_c__ROS_TYPE_MESSAGE:
      return copy_message(members_of(member), to, from);
    case rosidl_typesupport_introspection_c__ROS_TYPE_STRING:
      return rosidl_runtime_c__String__copy(static_cast<const rosidl_runtime_c__String*>(from),
                                            static_cast<rosidl_runtime_c__String*>(to));
    case rosidl_typesupport_introspection_c__ROS_TYPE_WSTRING:
      return rosidl_runtime_c__U16String__copy(
          static_cast<const rosidl_runtime_c__U16String*>(from),
          static_cast<rosidl_runtime_c__U16String*>(to));
    default:
      std::memcpy(to, from, size_of(member.type_id_));
      return true;
  }
}

bool copy_list(const Member& member, void* to, const void* from) {
  const std::size_t count = member.size_function(from);
  if (member.resize_function != nullptr && !member.resize_function(to, count)) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (!copy_item(member, member.get_function(to, i), member.get_const_function(from, i))) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool copy_message(const Members& members, void* to, const void* from) {
  for (std::uint32_t i = 0; i < members.member_count_; ++i) {
    const Member& member = members.members_[i];
    void* const there = static_cast<unsigned char*>(to) + member.offset_;
    const void* const here = static_cast<const unsigned char*>(from) + member.offset_;
    if (!(member.is_array_ ? copy_list : copy_item)(member, there, here)) return false;
  }
  return true;
}

std::string bytes_of(const rosidl_message_type_support_t& support, const void* message) {
  rmw_serialized_message_t serialized = rmw_get_zero_initialized_serialized_message();
  rcutils_allocator_t allocator = rcutils_get_default_allocator();
  std::string bytes;
  if (rmw_serialized_message_init(&serialized, 0, &allocator) == RMW_RET_OK &&
      rmw_serialize(message, &support, &serialized) == RMW_RET_OK) {
    bytes.assign(reinterpret_cast<const char*>(serialized.buffer), serialized.buffer_length);
  }
  if (rmw_serialized_message_fini(&serialized) != RMW_RET_OK || bytes.empty()) {
    rcutils_reset_error();
  }
  return bytes;
}

bool read_bytes(const rosidl_message_type_support_t& support, std::string_view bytes,
                void* message) {
  std::string copy(bytes);
  rmw_serialized_message_t serialized = rmw_get_zero_initialized_serialized_message();
  serialized.buffer = reinterpret_cast<std::uint8_t*>(copy.data());
  serialized.buffer_length = serialized.buffer_capacity = copy.size();
  serialized.allocator = rcutils_get_default_allocator();
  if (rmw_deserialize(&serialized, &support, message) == RMW_RET_OK) return true;
  rcutils_reset_error();
  return false;
}

Message::Message(const Members& members)
    : members_(members), bytes_(std::make_unique<unsigned char[]>(members.size_of_)) {
  members_.init_function(bytes_.get(), ROSIDL_RUNTIME_C_MSG_INIT_ALL);
}

void Message::reset() {
  members_.fini_function(bytes_.get());
  members_.init_function(bytes_.get(), ROSIDL_RUNTIME_C_MSG_INIT_ALL);
}

Message::~Message() {
  members_.fini_function(bytes_.get());
}

}  // namespace ros2
