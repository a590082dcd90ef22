#include "remote/json_lines/port_json.h"

#include <fmt/format.h>

#include <type_traits>

#include "core/json.h"
#include "plugin/contract/host.h"

namespace lockstep {
namespace {

template <class T>
Value got(bool (*get)(const lockstep_caller*, std::uint32_t, T*), const lockstep_caller& caller,
          std::uint32_t port) {
  T value{};
  return get(&caller, port, &value) ? Value(value) : Value();
}

template <class List, class Item>
Value got_list(bool (*get)(const lockstep_caller*, std::uint32_t, const Item**, std::size_t*),
               const lockstep_caller& caller, std::uint32_t port) {
  const Item* items = nullptr;
  std::size_t count = 0;
  if (!get(&caller, port, &items, &count)) return {};
  List list;
  for (std::size_t i = 0; i < count; ++i) {
    if constexpr (std::is_same_v<Item, lockstep_text>) {
      list.emplace_back(items[i].text, items[i].length);
    } else {
      list.push_back({items[i]});
    }
  }
  return list;
}

Value got_string(const lockstep_caller& caller, std::uint32_t port) {
  const char* text = nullptr;
  std::size_t length = 0;
  if (!host_table().get_string(&caller, port, &text, &length)) return {};
  return std::string(text, length);
}

void append_item(std::string& to, bool item) {
  to += item ? "true" : "false";
}
void append_item(std::string& to, Flag item) {
  append_item(to, item.is_set);
}
void append_item(std::string& to, std::int64_t item) {
  append_text(item, to);
}
void append_item(std::string& to, double item) {
  append_text(item, to);
}
void append_item(std::string& to, const std::string& item) {
  append_json(to, item);
}
void append_item(std::string& to, NoValue) {
  to += "null";
}
void append_item(std::string& to, const Object&) {
  to += "null";
}
template <class Item>
void append_item(std::string& to, const std::vector<Item>& items) {
  to += '[';
  const char* between = "";
  for (const Item& item : items) {
    to += between;
    append_item(to, item);
    between = ",";
  }
  to += ']';
}

template <class Item, class T>
bool set_list(bool (*set)(const lockstep_caller*, std::uint32_t, const T*, std::size_t),
              const lockstep_caller& caller, std::uint32_t port, JsonValue value, bool& is_list) {
  // Not std::vector<bool>, which has no array.
  std::vector<std::conditional_t<std::is_same_v<Item, bool>, Flag, Item>> items;
  is_list = value.is_list();
  if (!is_list) return false;
  value.each_item([&](JsonValue it) {
    Item item{};
    is_list &= it.get(item);
    items.push_back({item});
  });
  return is_list && set(&caller, port, reinterpret_cast<const T*>(items.data()), items.size());
}

bool set_texts(const lockstep_caller& caller, std::uint32_t port, JsonValue value, bool& is_list) {
  std::vector<lockstep_text> items;
  is_list = value.is_list();
  if (!is_list) return false;
  value.each_item([&](JsonValue it) {
    std::string_view text;
    is_list &= it.get(text);
    items.push_back({text.data(), text.size()});
  });
  return is_list && host_table().set_string_list(&caller, port, items.data(), items.size());
}

template <class T>
bool set_item(bool (*set)(const lockstep_caller*, std::uint32_t, T), const lockstep_caller& caller,
              std::uint32_t port, JsonValue value, bool& fits) {
  T item{};
  fits = value.get(item);
  return fits && set(&caller, port, item);
}

// `fits`: the value is of the port's type.
bool set_value(const lockstep_caller& caller, std::uint32_t port, JsonValue value, bool& fits) {
  const lockstep_host& host = host_table();
  switch (caller.ports[port].type) {
    case ValueType::Bool:
      return set_item(host.set_bool, caller, port, value, fits);
    case ValueType::Int:
      return set_item(host.set_int, caller, port, value, fits);
    case ValueType::Double:
      return set_item(host.set_double, caller, port, value, fits);
    case ValueType::DoubleList:
      return set_list<double>(host.set_double_list, caller, port, value, fits);
    case ValueType::IntList:
      return set_list<std::int64_t>(host.set_int_list, caller, port, value, fits);
    case ValueType::BoolList:
      return set_list<bool>(host.set_bool_list, caller, port, value, fits);
    case ValueType::StringList:
      return set_texts(caller, port, value, fits);
    case ValueType::String: {
      std::string_view text;
      fits = value.get(text);
      return fits && host.set_string(&caller, port, text.data(), text.size());
    }
    case ValueType::Number:
    case ValueType::Object:
      break;
  }
  return false;
}

}  // namespace

Value port_value(const lockstep_caller& caller, std::uint32_t port) {
  const lockstep_host& host = host_table();
  switch (caller.ports[port].type) {
    case ValueType::Bool:
      return got(host.get_bool, caller, port);
    case ValueType::Int:
      return got(host.get_int, caller, port);
    case ValueType::Double:
    case ValueType::Number:
      return got(host.get_double, caller, port);
    case ValueType::String:
      return got_string(caller, port);
    case ValueType::DoubleList:
      return got_list<std::vector<double>>(host.get_double_list, caller, port);
    case ValueType::IntList:
      return got_list<std::vector<std::int64_t>>(host.get_int_list, caller, port);
    case ValueType::BoolList:
      return got_list<std::vector<Flag>>(host.get_bool_list, caller, port);
    case ValueType::StringList:
      return got_list<std::vector<std::string>>(host.get_string_list, caller, port);
    case ValueType::Object:
      break;
  }
  return {};
}

void append_json_value(std::string& to, const Value& value) {
  std::visit([&](const auto& it) { append_item(to, it); }, value);
}

std::string set_port(const lockstep_caller& caller, std::uint32_t port, JsonValue value) {
  const BoundPort& it = caller.ports[port];
  bool fits = false;
  if (set_value(caller, port, value, fits) || caller.slot->error != nullptr) return {};
  if (!fits)
    return fmt::format("set '{}', a port of type {}, to another type", it.name, to_string(it.type));
  if (it.is_unbound()) return {};
  return fmt::format("set '{}', which is not bound to an entry that takes it", it.name);
}

}  // namespace lockstep
