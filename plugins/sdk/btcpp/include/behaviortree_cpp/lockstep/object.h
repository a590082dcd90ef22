// Values of a user's types as objects of the contract: shared, counted, and known by name.
#pragma once

#include <lockstep/leaf.h>
#include <lockstep/cpp/port_traits.hpp>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "behaviortree_cpp/basic_types.h"

namespace BT::lockstep_detail {

// As it is written. Where the contract does not take that as a name, what replaces it is made
// unique by a number.
std::string object_name(std::type_index type);

// The text of what the last from_text of this thread has thrown.
[[gnu::visibility("hidden")]] inline std::string& reason() {
  static thread_local std::string text;
  return text;
}
[[gnu::visibility("hidden")]] inline const char* why_no_object() {
  return reason().empty() ? nullptr : reason().c_str();
}

template <class T>
TypeInfo type_info_of();  // lockstep/ports.h has it

template <class T>
struct ObjectCalls {
  using Holder = lockstep::detail::ObjectHolder<T>;
  using Common = lockstep::detail::ObjectFunctions<T>;

  static std::size_t copy(const std::string& text, void* room, std::size_t size) {
    text.copy(static_cast<char*>(room), size);
    return text.size();
  }
  static std::string json_of(const void* object) {
    return find_json(typeid(T))->write(static_cast<const Holder*>(object)->value.get());
  }
  static void* made_from(T value) {
    return new Holder{std::make_shared<const T>(std::move(value))};
  }

  static std::size_t to_text(const void* object, char* text, std::size_t size) {
    std::size_t length = 0;
    lockstep::detail::catching([&] { length = copy(json_of(object), text, size); },
                               [](const char*) {});
    return length;
  }
  static std::size_t to_bytes(const void* object, void* bytes, std::size_t size) {
    std::size_t length = SIZE_MAX;
    lockstep::detail::catching([&] { length = copy(json_of(object), bytes, size); },
                               [](const char*) {});
    return length;
  }
  static void* from_text(const char* text, std::size_t length) {
    void* object = nullptr;
    reason().clear();
    lockstep::detail::catching(
        [&] { object = made_from(convertFromString<T>(StringView(text, length))); },
        [](const char* what) { reason() = what; });
    return object;
  }
  static void* from_bytes(const void* bytes, std::size_t length) {
    void* object = nullptr;
    lockstep::detail::catching(
        [&] {
          Any value;
          if (read_json(typeid(T), {static_cast<const char*>(bytes), length}, value)) {
            object = made_from(value.cast<T>());
          }
        },
        [](const char*) {});
    return object;
  }
};

// Whether a cast from the type of that name is registered: by the plugin, or the program that makes
// a tree now.
[[gnu::visibility("hidden")]] bool reads_object(std::type_index type, const char* name);

// The types of objects that this shared object knows: a list that only grows, from any thread.
struct KnownObject {
  const lockstep_object_type* type;
  Any (*value)(const void* object);  // shared, not copied
  TypeInfo (*info)();
  const KnownObject* next;
};
[[gnu::visibility("hidden")]] inline std::atomic<const KnownObject*>& first_known_object() {
  static std::atomic<const KnownObject*> first = nullptr;
  return first;
}
void know_object(KnownObject& it);

// Made when it is first asked for: when the plugin has registered its types for JSON.
template <class T>
const lockstep_object_type* object_type() {
  static const std::string name = object_name(typeid(T));
  static const lockstep_object_type table = [] {
    using Calls = ObjectCalls<T>;
    lockstep_object_type type{};
    type.struct_size = sizeof type;
    type.name = name.c_str();
    type.retain = Calls::Common::retain;
    type.release = Calls::Common::release;
    type.from_text = Calls::from_text;
    type.why_no_object = why_no_object;
    if constexpr (is_shared_pointer_v<T>) {
      type.reads = [](const char* from) { return reads_object(typeid(T), from); };
    }
    const JsonFunctions* const json = find_json(typeid(T));
    if (json != nullptr && json->write) type.to_text = Calls::to_text;
    if (json != nullptr && json->write && json->read) {
      type.to_bytes = Calls::to_bytes;
      type.from_bytes = Calls::from_bytes;
    }
    return type;
  }();
  static KnownObject known{
      &table,
      [](const void* object) {
        using Holder = typename ObjectCalls<T>::Holder;
        const auto& value = static_cast<const Holder*>(object)->value;
        return Any::lockstep_share(std::const_pointer_cast<T>(value));  // a copy of it is changed
      },
      type_info_of<T>, nullptr};
  static const bool is_known = (know_object(known), true);
  static_cast<void>(is_known);
  return &table;
}

}  // namespace BT::lockstep_detail

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/object.h"  // IWYU pragma: export
#endif
