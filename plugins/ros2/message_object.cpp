#include "message_object.hpp"

#include <rcutils/error_handling.h>
#include <rmw/rmw.h>
#include <rmw/serialized_message.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "field_values.hpp"
#include "types.hpp"

namespace ros2 {
namespace {

constexpr const char* kPrefix = "ros2:";

struct Object {
  explicit Object(const Members& of) : message(of), members(of) {}

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
  return kPrefix + name + "/" + members.message_name_;
}

// For a separate process: the name of the type, a NUL, and the message as it goes over the network.
// Parts of actions and services do not go there.
constexpr std::size_t kCannot = SIZE_MAX;

class Serialized {
 public:
  Serialized() : it_(rmw_get_zero_initialized_serialized_message()) {
    const rcutils_allocator_t allocator = rcutils_get_default_allocator();
    is_made_ = rmw_serialized_message_init(&it_, 0, &allocator) == RMW_RET_OK;
  }
  ~Serialized() {
    if (is_made_ && rmw_serialized_message_fini(&it_) != RMW_RET_OK) rcutils_reset_error();
  }
  Serialized(const Serialized&) = delete;
  Serialized& operator=(const Serialized&) = delete;
  bool is_made() const { return is_made_; }
  rmw_serialized_message_t& get() { return it_; }

 private:
  rmw_serialized_message_t it_;
  bool is_made_ = false;
};

std::size_t to_bytes(const void* object, void* bytes, std::size_t size) {
  const auto& it = *static_cast<const Object*>(object);
  const std::string name = name_of(it.members).substr(std::strlen(kPrefix));
  auto type = message_type(name);
  Serialized message;
  if (!type || !message.is_made() ||
      rmw_serialize(it.message.get(), (*type)->support, &message.get()) != RMW_RET_OK) {
    rcutils_reset_error();
    return kCannot;
  }
  std::string all = name + '\0';
  all.append(reinterpret_cast<const char*>(message.get().buffer), message.get().buffer_length);
  std::memcpy(bytes, all.data(), std::min(size, all.size()));
  return all.size();
}

void* from_bytes(const void* bytes, std::size_t length) {
  const std::string all(static_cast<const char*>(bytes), length);
  const auto end = all.find('\0');
  auto type = message_type(all.substr(0, end));
  Serialized message;
  if (end == std::string::npos || !type || !message.is_made()) return nullptr;
  const std::size_t rest = length - end - 1;
  if (rmw_serialized_message_resize(&message.get(), rest) != RMW_RET_OK) return nullptr;
  std::memcpy(message.get().buffer, all.data() + end + 1, rest);
  message.get().buffer_length = rest;
  auto object = std::make_unique<Object>(*(*type)->members);
  if (rmw_deserialize(&message.get(), (*type)->support, object->message.get()) == RMW_RET_OK) {
    return object.release();
  }
  rcutils_reset_error();
  return nullptr;
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
    it.type.to_bytes = to_bytes;
    it.type.from_bytes = from_bytes;
  }
  return it.type;
}

void* make_object(const Members& members, const void* message) {
  auto* const object = new Object(members);
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
