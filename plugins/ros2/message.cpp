#include "message.hpp"

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
