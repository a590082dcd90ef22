#include "field_values.hpp"

#include <rosidl_runtime_c/string.h>
#include <rosidl_runtime_c/string_functions.h>
#include <rosidl_typesupport_introspection_c/field_types.h>
#include <time.h>

#include <memory>
#include <type_traits>
#include <vector>

namespace ros2 {
namespace {

using Kind = Field::Kind;
using String = rosidl_runtime_c__String;

// Calls `function` with a reference to the scalar of this type at `address`.
template <class Function>
auto with_scalar(std::uint8_t type, void* address, Function function) {
  switch (type) {
    case rosidl_typesupport_introspection_c__ROS_TYPE_FLOAT:
      return function(*static_cast<float*>(address));
    case rosidl_typesupport_introspection_c__ROS_TYPE_DOUBLE:
      return function(*static_cast<double*>(address));
    case rosidl_typesupport_introspection_c__ROS_TYPE_BOOLEAN:
      return function(*static_cast<bool*>(address));
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT8:
      return function(*static_cast<std::int8_t*>(address));
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT16:
      return function(*static_cast<std::uint16_t*>(address));
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT16:
      return function(*static_cast<std::int16_t*>(address));
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT32:
      return function(*static_cast<std::uint32_t*>(address));
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT32:
      return function(*static_cast<std::int32_t*>(address));
    case rosidl_typesupport_introspection_c__ROS_TYPE_UINT64:
      return function(*static_cast<std::uint64_t*>(address));
    case rosidl_typesupport_introspection_c__ROS_TYPE_INT64:
      return function(*static_cast<std::int64_t*>(address));
    default:
      return function(*static_cast<std::uint8_t*>(address));
  }
}

template <class T>
void put_number(std::uint8_t type, void* address, T value) {
  with_scalar(type, address,
              [&](auto& scalar) { scalar = static_cast<std::decay_t<decltype(scalar)>>(value); });
}

template <class T>
T number_at(std::uint8_t type, const void* address) {
  return with_scalar(type, const_cast<void*>(address),
                     [](auto& scalar) { return static_cast<T>(scalar); });
}

bool put_text(void* address, const char* text, std::size_t length) {
  return rosidl_runtime_c__String__assignn(static_cast<String*>(address), text, length);
}

void* address_in(const Field& field, void* message) {
  return static_cast<unsigned char*>(message) + field.offset;
}
const void* address_in(const Field& field, const void* message) {
  return static_cast<const unsigned char*>(message) + field.offset;
}

std::size_t count_in(const Field& field, const void* message) {
  return field.member->size_function(address_in(field, message));
}
const void* item_of(const Field& field, const void* message, std::size_t index) {
  return field.member->get_const_function(address_in(field, message), index);
}

std::string too_long(const Field& field, std::size_t has, std::size_t most, const char* what) {
  return "'" + field.path + "' has " + std::to_string(has) + " " + what + ", expected at most " +
         std::to_string(most);
}

// Makes room for the items of a list. "" or what is wrong.
std::string resize(const Field& field, void* list, std::size_t count) {
  const Member& member = *field.member;
  if (member.is_upper_bound_ && count > member.array_size_) {
    return too_long(field, count, member.array_size_, "items");
  }
  if (member.resize_function != nullptr) {
    return member.resize_function(list, count) ? "" : "there is no memory for '" + field.path + "'";
  }
  if (count == member.array_size_) return {};
  return "'" + field.path + "' has " + std::to_string(count) + " items, expected " +
         std::to_string(member.array_size_);
}

template <class Item, class Put>
std::string put_list(const Field& field, void* message, const Item* items, std::size_t count,
                     Put put) {
  void* const list = address_in(field, message);
  if (std::string wrong = resize(field, list, count); !wrong.empty()) return wrong;
  for (std::size_t i = 0; i < count; ++i) {
    put(field.member->get_function(list, i), items[i]);
  }
  return {};
}

template <class Item>
std::string put_numbers(const Field& field, void* message, const Item* items, std::size_t count) {
  return put_list(field, message, items, count,
                  [&](void* at, Item item) { put_number(field.member->type_id_, at, item); });
}

std::string put_string(const Field& field, void* message, const char* text, std::size_t length) {
  const std::size_t most = field.member->string_upper_bound_;
  if (most != 0 && length > most) return too_long(field, length, most, "bytes");
  return put_text(address_in(field, message), text, length)
             ? ""
             : "there is no memory for '" + field.path + "'";
}

// The only value that a whole stamp has.
void put_now(const Field& field, void* message) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  auto* const stamp = static_cast<std::int32_t*>(address_in(field, message));
  stamp[0] = static_cast<std::int32_t>(now.tv_sec);
  stamp[1] = static_cast<std::int32_t>(now.tv_nsec);
}

}  // namespace

std::string read_port(const PortOf& from, const Field& field, void* message) {
  const auto& [host, caller, port] = from;
  const std::uint8_t type = field.member == nullptr ? 0 : field.member->type_id_;
  std::size_t count = 0;
  switch (field.kind) {
    case Kind::Bool:
      if (bool value{}; host->get_bool(caller, port, &value)) {
        put_number(type, address_in(field, message), value);
      }
      return {};
    case Kind::Int:
      if (std::int64_t value{}; host->get_int(caller, port, &value)) {
        put_number(type, address_in(field, message), value);
      }
      return {};
    case Kind::Double:
      if (double value{}; host->get_double(caller, port, &value)) {
        put_number(type, address_in(field, message), value);
      }
      return {};
    case Kind::String:
      if (const char* text{}; host->get_string(caller, port, &text, &count)) {
        return put_string(field, message, text, count);
      }
      return {};
    case Kind::Time:
      if (const char* text{}; host->get_string(caller, port, &text, &count)) {
        put_now(field, message);
      }
      return {};
    case Kind::BoolList:
      if (const bool* items{}; host->get_bool_list(caller, port, &items, &count)) {
        return put_numbers(field, message, items, count);
      }
      return {};
    case Kind::IntList:
      if (const std::int64_t * items{}; host->get_int_list(caller, port, &items, &count)) {
        return put_numbers(field, message, items, count);
      }
      return {};
    case Kind::DoubleList:
      if (const double* items{}; host->get_double_list(caller, port, &items, &count)) {
        return put_numbers(field, message, items, count);
      }
      return {};
    case Kind::StringList:
      if (const lockstep_text * items{}; host->get_string_list(caller, port, &items, &count)) {
        return put_list(field, message, items, count, [](void* at, const lockstep_text& item) {
          put_text(at, item.text, item.length);
        });
      }
      return {};
    case Kind::Messages:
      return {};
  }
  return {};
}

void write_port(const PortOf& to, const Field& field, const void* message) {
  const auto& [host, caller, port] = to;
  const std::uint8_t type = field.member == nullptr ? 0 : field.member->type_id_;
  const void* const at = address_in(field, message);
  switch (field.kind) {
    case Kind::Bool:
      host->set_bool(caller, port, number_at<bool>(type, at));
      return;
    case Kind::Int:
      host->set_int(caller, port, number_at<std::int64_t>(type, at));
      return;
    case Kind::Double:
      host->set_double(caller, port, number_at<double>(type, at));
      return;
    case Kind::String: {
      const auto& text = *static_cast<const String*>(at);
      host->set_string(caller, port, text.data, text.size);
      return;
    }
    case Kind::BoolList: {
      const std::size_t count = count_in(field, message);
      const auto items = std::make_unique<bool[]>(count);
      for (std::size_t i = 0; i < count; ++i) {
        items[i] = number_at<bool>(type, item_of(field, message, i));
      }
      host->set_bool_list(caller, port, items.get(), count);
      return;
    }
    case Kind::IntList: {
      std::vector<std::int64_t> items(count_in(field, message));
      for (std::size_t i = 0; i < items.size(); ++i) {
        items[i] = number_at<std::int64_t>(type, item_of(field, message, i));
      }
      host->set_int_list(caller, port, items.data(), items.size());
      return;
    }
    case Kind::DoubleList: {
      std::vector<double> items(count_in(field, message));
      for (std::size_t i = 0; i < items.size(); ++i) {
        items[i] = number_at<double>(type, item_of(field, message, i));
      }
      host->set_double_list(caller, port, items.data(), items.size());
      return;
    }
    case Kind::StringList: {
      std::vector<lockstep_text> items(count_in(field, message));
      for (std::size_t i = 0; i < items.size(); ++i) {
        const auto& text = *static_cast<const String*>(item_of(field, message, i));
        items[i] = {text.data, text.size};
      }
      host->set_string_list(caller, port, items.data(), items.size());
      return;
    }
    case Kind::Time:
    case Kind::Messages:
      return;
  }
}

std::optional<double> number_in(const Field& field, const void* message) {
  const bool is_number =
      field.kind == Kind::Bool || field.kind == Kind::Int || field.kind == Kind::Double;
  if (!is_number) return std::nullopt;
  return number_at<double>(field.member->type_id_, address_in(field, message));
}

std::optional<double> size_in(const Field& field, const void* message) {
  if (field.kind == Kind::String) {
    return double(static_cast<const String*>(address_in(field, message))->size);
  }
  if (field.member == nullptr || !field.member->is_array_) return std::nullopt;
  return double(count_in(field, message));
}

}  // namespace ros2
