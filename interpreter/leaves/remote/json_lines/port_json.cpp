#include "leaves/remote/json_lines/port_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "base/core/value_types.h"
#include "base/json/json.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

void append_item(std::string& to, bool item) {
  to += item ? "true" : "false";
}
void append_item(std::string& to, Flag item) {
  append_item(to, item.is_set);
}
template <IsNumber Number>
void append_item(std::string& to, Number item) {
  append_text(item, to);
  if (item == 0 && std::signbit(static_cast<double>(item))) to += ".0";  // -0 is a whole number
}
void append_item(std::string& to, const std::string& item) {
  append_json(to, item);
}
void append_item(std::string& to, const NoValue&) {
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

// False: the value has another type.
template <class T>
bool read_item(JsonValue value, T& item) {
  return value.get(item);
}
template <std::floating_point Real>
bool read_item(JsonValue value, Real& item) {
  double number = 0;
  const bool is_number = value.get(number);
  item = static_cast<Real>(number);
  return is_number;
}
bool read_item(JsonValue value, Flag& item) {
  return value.get(item.is_set);
}
bool read_item(JsonValue value, std::string& item) {
  std::string_view text;
  if (!value.get(text)) return false;
  item = text;
  return true;
}
template <class Item>
bool read_item(JsonValue value, std::vector<Item>& items) {
  bool is_list = value.is_list();
  if (!is_list) return false;
  value.each_item([&](JsonValue it) { is_list &= read_item(it, items.emplace_back()); });
  return is_list;
}
bool read_item(JsonValue /*value*/, NoValue& /*item*/) {
  return false;
}
bool read_item(JsonValue /*value*/, Object& /*item*/) {
  return false;
}

// The value as one of this type; NoValue if it is none.
Value value_of(JsonValue value, ValueType type) {
  return with_type(type, [&]<class T>(std::type_identity<T>) {
    T item{};
    return read_item(value, item) ? Value(std::move(item)) : Value();
  });
}

}  // namespace

bool is_same(const Value& value, const Value& other) {
  if (!(value == other)) return false;
  const auto has_sign = [](double it) { return std::signbit(it); };
  if (const auto* number = std::get_if<double>(&value)) {
    return has_sign(*number) == has_sign(std::get<double>(other));
  }
  const auto* const list = std::get_if<std::vector<double>>(&value);
  return list == nullptr ||
         std::ranges::equal(*list, std::get<std::vector<double>>(other), {}, has_sign, has_sign);
}

Value port_value(const lockstep_caller& caller, std::uint32_t port) {
  const Value* const value = read_port(caller, port);
  if (value == nullptr) return {};
  const auto* const whole = std::get_if<std::int64_t>(value);
  const bool is_number = caller.ports[port]->type == ValueType::Number;
  return is_number && whole != nullptr ? Value(static_cast<double>(*whole)) : *value;
}

void append_json_value(std::string& to, const Value& value) {
  std::visit([&](const auto& it) { append_item(to, it); }, value);
}

std::string set_port(const lockstep_caller& caller, std::uint32_t port, JsonValue value) {
  const BoundPort& it = *caller.ports[port];
  const Value taken = value_of(value, it.type);
  const bool fits = !std::holds_alternative<NoValue>(taken);
  if ((fits && write_port(caller, port, taken)) || caller.slot->error != nullptr) return {};
  if (!fits)
    return fmt::format("set '{}', a port of type {}, to another type", it.name(),
                       to_string(it.type));
  if (it.is_unbound()) return {};
  return fmt::format("set '{}', which is not bound to an entry that takes it", it.name());
}

}  // namespace lockstep::host
