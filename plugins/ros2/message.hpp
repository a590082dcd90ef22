// A message of a type that is known by introspection only.
#pragma once

#include <rosidl_runtime_c/message_type_support_struct.h>
#include <rosidl_typesupport_introspection_c/message_introspection.h>

#include <memory>
#include <string>
#include <string_view>

namespace ros2 {

using Members = rosidl_typesupport_introspection_c__MessageMembers;
using Member = rosidl_typesupport_introspection_c__MessageMember;

// The member of this name; the types that use this have it.
const Member& member_named(const Members& members, const char* name);
const Members& members_of(const Member& member);

// False: there is no memory. Both have been initialized.
bool copy_message(const Members& members, void* to, const void* from);

// As it is sent; "" if ROS has failed.
std::string bytes_of(const rosidl_message_type_support_t& support, const void* message);
// Into a message that has been initialized. False: these are no bytes of one.
bool read_bytes(const rosidl_message_type_support_t& support, std::string_view bytes,
                void* message);

class Message {
 public:
  explicit Message(const Members& members);
  ~Message();
  Message(const Message&) = delete;
  Message& operator=(const Message&) = delete;

  // As it was made: rmw forgets what a message had when it takes another one into it, unfreed.
  void reset();
  void* get() { return bytes_.get(); }
  const void* get() const { return bytes_.get(); }
  template <class T = void>
  T* at(std::size_t offset) {
    return reinterpret_cast<T*>(bytes_.get() + offset);
  }

 private:
  const Members& members_;
  std::unique_ptr<unsigned char[]> bytes_;
};

}  // namespace ros2
