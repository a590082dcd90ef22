#include "field_values.hpp"

#include <rosidl_runtime_c/string.h>
#include <rosidl_runtime_c/string_functions.h>
#include <rosidl_typesupport_introspection_c/field_types.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <type_traits>
#include <vector>

#include "message_object.hpp"
#include "time_source.hpp"

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

std::size_t rows_in(const Rows& rows, const void* message) {
  return rows.member->size_function(static_cast<const unsigned char*>(message) + rows.offset);
}
void* row_of(const Rows& rows, void* message, std::size_t index) {
  return rows.member->get_function(static_cast<unsigned char*>(message) + rows.offset, index);
}
const void* row_of(const Rows& rows, const void* message, std::size_t index) {
  return rows.member->get_const_function(static_cast<const unsigned char*>(message) + rows.offset,
                                         index);
}

std::size_t count_in(const Field& field, const void* message) {
  return field.member->size_function(address_in(field, message));
}

// The items of a list, or of a column from the first message on.
template <class Visit>
void for_each_item(const Field& field, const void* message, Visit visit) {
  const auto visit_list = [&](const void* list) {
    const std::size_t count = field.member->size_function(list);
    for (std::size_t i = 0; i < count; ++i) visit(field.member->get_const_function(list, i));
  };
  if (field.rows == nullptr) return visit_list(address_in(field, message));
  const std::size_t rows = rows_in(*field.rows, message);
  for (std::size_t i = 0; i < rows; ++i) {
    const void* const at = address_in(field, row_of(*field.rows, message, i));
    field.member->is_array_ ? visit_list(at) : visit(at);
  }
}

std::string too_long(const std::string& path, std::size_t has, std::size_t most, const char* what) {
  return "'" + path + "' has " + std::to_string(has) + " " + what + ", expected at most " +
         std::to_string(most);
}

// Makes room for the items of a list. "" or what is wrong.
std::string resize(const std::string& path, const Member& member, void* list, std::size_t count) {
  if (member.is_upper_bound_ && count > member.array_size_) {
    return too_long(path, count, member.array_size_, "items");
  }
  if (member.resize_function != nullptr) {
    return member.resize_function(list, count) ? "" : "there is no memory for '" + path + "'";
  }
  if (count == member.array_size_) return {};
  return "'" + path + "' has " + std::to_string(count) + " items, expected " +
         std::to_string(member.array_size_);
}

// A column: one value for each message, or one for all; of lists, as many values for each.
template <class Item, class Put>
std::string put_column(const Field& field, void* message, const Item* items, std::size_t count,
                       Put put) {
  const std::size_t rows = rows_in(*field.rows, message);
  const bool is_list = field.member->is_array_;
  if (is_list ? count % std::max<std::size_t>(rows, 1) != 0 : count != rows && count != 1) {
    return "'" + field.path + "' has " + std::to_string(count) + " values for the " +
           std::to_string(rows) + " items of '" + field.rows->path + "'";
  }
  const std::size_t each = is_list && rows != 0 ? count / rows : 1;
  for (std::size_t i = 0; i < rows; ++i) {
    void* const at = address_in(field, row_of(*field.rows, message, i));
    if (!is_list) {
      put(at, items[count == 1 ? 0 : i]);
      continue;
    }
    if (std::string wrong = resize(field.path, *field.member, at, each); !wrong.empty())
      return wrong;
    for (std::size_t j = 0; j < each; ++j) {
      put(field.member->get_function(at, j), items[i * each + j]);
    }
  }
  return {};
}

template <class Item, class Put>
std::string put_list(const Field& field, void* message, const Item* items, std::size_t count,
                     Put put) {
  if (field.rows != nullptr) return put_column(field, message, items, count, put);
  void* const list = address_in(field, message);
  std::string wrong = resize(field.path, *field.member, list, count);
  if (!wrong.empty()) return wrong;
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
  if (most != 0 && length > most) return too_long(field.path, length, most, "bytes");
  return put_text(address_in(field, message), text, length)
             ? ""
             : "there is no memory for '" + field.path + "'";
}

constexpr std::int64_t kSecond = 1'000'000'000;

// A stamp or a duration: seconds, which may be negative, and nanoseconds, which are not.
void put_time(const Field& field, void* message, std::int64_t nanoseconds) {
  auto* const parts = static_cast<std::int32_t*>(address_in(field, message));
  const std::int64_t rest = (nanoseconds % kSecond + kSecond) % kSecond;
  parts[0] = static_cast<std::int32_t>((nanoseconds - rest) / kSecond);
  parts[1] = static_cast<std::int32_t>(rest);
}
double seconds_in(const Field& field, const void* message) {
  const auto* const parts = static_cast<const std::int32_t*>(address_in(field, message));
  return parts[0] + static_cast<std::uint32_t>(parts[1]) / 1e9;
}

// How many values a list port has now; nothing: it has none.
std::optional<std::size_t> length_of(const PortOf& from, Kind kind) {
  const auto& [host, caller, port] = from;
  std::size_t count = 0;
  const bool* flags = nullptr;
  const std::int64_t* wholes = nullptr;
  const double* numbers = nullptr;
  const lockstep_text* texts = nullptr;
  const bool has_one = kind == Kind::BoolList  ? host->get_bool_list(caller, port, &flags, &count)
                       : kind == Kind::IntList ? host->get_int_list(caller, port, &wholes, &count)
                       : kind == Kind::DoubleList
                           ? host->get_double_list(caller, port, &numbers, &count)
                           : host->get_string_list(caller, port, &texts, &count);
  return has_one ? std::optional(count) : std::nullopt;
}

}  // namespace

std::string size_rows(const lockstep_host& host, const lockstep_caller* caller,
                      const FieldPorts& ports, void* message) {
  std::map<const Rows*, std::size_t> sizes;
  for (const auto& [port, field] : ports) {
    if (field->rows == nullptr) continue;
    const auto length = length_of({&host, caller, port}, field->kind);
    if (!length) continue;
    std::size_t& size = sizes[field->rows.get()];
    size = std::max(size, field->member->is_array_ ? std::min<std::size_t>(*length, 1) : *length);
  }
  for (const auto& [rows, size] : sizes) {
    // What an object has already stays, but for the columns.
    const std::size_t has = rows_in(*rows, message);
    if (has == size || (has > 1 && size == 1)) continue;
    std::string wrong = resize(rows->path, *rows->member,
                               static_cast<unsigned char*>(message) + rows->offset, size);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

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
    case Kind::Duration:
      if (double value{}; host->get_double(caller, port, &value)) {
        put_time(field, message, std::llround(value * 1e9));
      }
      return {};
    case Kind::String:
      if (const char* text{}; host->get_string(caller, port, &text, &count)) {
        return put_string(field, message, text, count);
      }
      return {};
    case Kind::Time:
      if (const char* text{}; host->get_string(caller, port, &text, &count)) {
        put_time(field, message, ros_now());
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
    case Kind::Object:
      if (void* object{}; host->get_object(caller, port, &object) && object != nullptr) {
        return copy_object(*field.message, address_in(field, message), object)
                   ? ""
                   : "there is no memory for '" + field.path + "'";
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
  const void* const at = field.rows == nullptr ? address_in(field, message) : nullptr;
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
    case Kind::Duration:
      host->set_double(caller, port, seconds_in(field, message));
      return;
    case Kind::String: {
      const auto& text = *static_cast<const String*>(at);
      host->set_string(caller, port, text.data, text.size);
      return;
    }
    case Kind::BoolList: {
      std::vector<char> flags;
      for_each_item(field, message,
                    [&](const void* item) { flags.push_back(number_at<bool>(type, item)); });
      host->set_bool_list(caller, port, reinterpret_cast<const bool*>(flags.data()), flags.size());
      return;
    }
    case Kind::IntList: {
      std::vector<std::int64_t> items;
      for_each_item(field, message, [&](const void* item) {
        items.push_back(number_at<std::int64_t>(type, item));
      });
      host->set_int_list(caller, port, items.data(), items.size());
      return;
    }
    case Kind::DoubleList: {
      std::vector<double> items;
      for_each_item(field, message,
                    [&](const void* item) { items.push_back(number_at<double>(type, item)); });
      host->set_double_list(caller, port, items.data(), items.size());
      return;
    }
    case Kind::StringList: {
      std::vector<lockstep_text> items;
      for_each_item(field, message, [&](const void* item) {
        const auto& text = *static_cast<const String*>(item);
        items.push_back({text.data, text.size});
      });
      host->set_string_list(caller, port, items.data(), items.size());
      return;
    }
    case Kind::Object: {
      void* const object = object_in(field, message);
      if (object == nullptr) return;
      host->set_object(caller, port, object);
      release_object(object);
      return;
    }
    case Kind::Time:
    case Kind::Messages:
      return;
  }
}

void* object_in(const Field& field, const void* message) {
  return make_object(*field.message, address_in(field, message));
}

std::string text_of(const Members& members, const void* message) {
  std::string all;
  const auto add = [&](const std::string& path, const std::string& value) {
    all += (all.empty() ? "" : ", ") + path + ": " + value;
  };
  for (const Field& field : fields_of(members)) {
    const auto number = number_in(field, message);
    char text[32];
    if (number && *number != 0) {
      std::snprintf(text, sizeof text, "%.6g", *number);
      add(field.path, text);
    } else if (field.kind == Kind::String) {
      const auto& it = *static_cast<const String*>(address_in(field, message));
      if (it.size != 0) add(field.path, {it.data, it.size});
    } else if (field.kind == Kind::Messages || (field.rows == nullptr && size_in(field, message))) {
      const double size = *size_in(field, message);
      if (size != 0) add(field.path, std::to_string(int(size)) + " items");
    }
  }
  return all;
}

std::optional<double> number_in(const Field& field, const void* message) {
  const bool is_number =
      field.kind == Kind::Bool || field.kind == Kind::Int || field.kind == Kind::Double;
  if (field.kind == Kind::Duration) return seconds_in(field, message);
  if (!is_number) return std::nullopt;
  return number_at<double>(field.member->type_id_, address_in(field, message));
}

void set_number(const Field& field, void* message, double value) {
  void* const at = address_in(field, message);
  if (field.kind == Kind::Bool) return put_number(field.member->type_id_, at, value != 0);
  if (field.kind == Kind::Double) return put_number(field.member->type_id_, at, value);
  constexpr double kMost = 9e15;  // whole numbers are exact up to here
  const bool is_any = field.min == 0 && field.max == 0;
  const double low = is_any ? -kMost : field.min,
               high = is_any ? kMost : std::min(field.max, kMost);
  put_number(field.member->type_id_, at, std::round(std::clamp(value, low, high)));
}

std::optional<double> size_in(const Field& field, const void* message) {
  if (field.kind == Kind::String) {
    return double(static_cast<const String*>(address_in(field, message))->size);
  }
  if (field.rows != nullptr) return double(rows_in(*field.rows, message));
  if (field.member == nullptr || !field.member->is_array_) return std::nullopt;
  return double(count_in(field, message));
}

}  // namespace ros2
