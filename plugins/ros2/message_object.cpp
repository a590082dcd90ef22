#include "message_object.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <mutex>
#include <string>

#include "field_values.hpp"

namespace ros2 {
namespace {

struct Object {
  Message message;
  const Members& members;
  std::atomic<unsigned> references{1};
};

void retain(void* object) {
  static_cast<Object*>(object)->references.fetch_add(1, std::memory_order_relaxed);
}

// The numbers and texts that are not what a new message has, as far as recordings need them.
std::size_t to_text(const void* object, char* text, std::size_t size) {
  const auto& it = *static_cast<const Object*>(object);
  const std::string all = text_of(it.members, it.message.get());
  std::memcpy(text, all.data(), std::min(size, all.size()));
  return all.size();
}

std::string name_of(const Members& members) {
  std::string name = members.message_namespace_;
  for (auto at = name.find("__"); at != std::string::npos; at = name.find("__", at)) {
    name.replace(at, 2, "/");
  }
  return "ros2:" + name + "/" + members.message_name_;
}

struct Named {
  std::string name;
  lockstep_object_type type{};
};

}  // namespace

const lockstep_object_type& object_type(const Members& members) {
  static std::mutex mutex;
  // For ever: ports point to them.
  static auto& known = *new std::map<std::string, Named>;
  const std::lock_guard lock(mutex);
  const std::string name = name_of(members);
  Named& it = known[name];
  if (it.name.empty()) {
    it.name = name;
    it.type.struct_size = sizeof it.type;
    it.type.name = it.name.c_str();
    it.type.retain = retain;
    it.type.release = release_object;
    it.type.to_text = to_text;
  }
  return it.type;
}

void* make_object(const Members& members, const void* message) {
  auto* const object = new Object{Message(members), members};
  if (copy_message(members, object->message.get(), message)) return object;
  delete object;
  return nullptr;
}

void release_object(void* object) {
  auto* const it = static_cast<Object*>(object);
  if (it->references.fetch_sub(1, std::memory_order_acq_rel) == 1) delete it;
}

bool copy_object(const Members& members, void* message, const void* object) {
  return copy_message(members, message, static_cast<const Object*>(object)->message.get());
}

}  // namespace ros2
