#include "base/blackboard/conversion.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>

#include "base/core/value_types.h"
#include "base/json/reader.h"

namespace lockstep::host {
namespace {

template <class Number>
std::optional<FromText<Number>> front_number(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc()) return std::nullopt;
  return FromText<Number>{number, rest != end};
}

template <IsNumber Number>
std::optional<FromText<Number>> read_item(std::string_view text, Number /*type*/) {
  return front_number<Number>(text);
}

std::optional<FromText<Flag>> read_item(std::string_view text, Flag /*type*/) {
  const auto flag = parse_flag(text);
  return flag ? std::optional(FromText<Flag>{{*flag}, false}) : std::nullopt;
}

std::optional<FromText<std::string>> read_item(std::string_view text, const std::string& /*type*/) {
  return FromText<std::string>{std::string(text), false};
}

template <class T>
std::optional<FromText<Value>> read(std::string_view text, std::type_identity<T>) {
  auto found = read_item(text, T{});
  if (!found) return std::nullopt;
  return FromText<Value>{Value(std::move(found->value)), found->has_rest};
}

template <std::floating_point Real>
bool get_item(JsonValue& item, Real& number) {
  double real = 0;
  const bool is_number = item.get(real);
  number = static_cast<Real>(real);
  return is_number;
}
bool get_item(JsonValue& item, std::int64_t& number) {
  double real = 0;
  if (!item.get(real)) return false;
  const auto whole = to_whole(real);
  number = whole.value_or(0);
  return whole.has_value();
}
bool get_item(JsonValue& item, Flag& flag) {
  return item.get(flag.is_set);
}
bool get_item(JsonValue& item, std::string& text) {
  std::string_view found;
  if (!item.get(found)) return false;
  text = found;
  return true;
}

// "[1, 2]"
template <class T>
std::optional<FromText<Value>> read_json_list(std::string_view text) {
  std::string object = fmt::format("{{\"list\":{}}}", text);
  std::vector<T> list;
  std::size_t fields = 0;
  bool good = true;
  const auto read_items = [&](std::string_view, JsonValue value) {
    ++fields;
    value.each_item([&](JsonValue item) { good = get_item(item, list.emplace_back()) && good; });
  };
  try {
    JsonReader().read(object, [&](JsonObject it) { it.each_field(read_items); });
  } catch (const JsonError&) {
    return std::nullopt;
  }
  if (!good || fields != 1) return std::nullopt;
  return FromText<Value>{Value(std::move(list)), false};
}

// Parts between ';'; one at the end is ignored.
template <class T>
std::optional<FromText<Value>> read(std::string_view text, std::type_identity<std::vector<T>>) {
  constexpr std::string_view kJson = "json:";
  if (text.starts_with(kJson)) return read_json_list<T>(text.substr(kJson.size()));
  std::vector<T> list;
  bool has_rest = false;
  while (!text.empty()) {
    const auto length = std::min(text.find(';'), text.size());
    auto item = read_item(text.substr(0, length), T{});
    if (!item) return std::nullopt;
    list.push_back(std::move(item->value));
    has_rest = has_rest || item->has_rest;
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return FromText<Value>{Value(std::move(list)), has_rest};
}

std::optional<FromText<Value>> read(std::string_view /*text*/, std::type_identity<NoValue>) {
  return std::nullopt;
}
std::optional<FromText<Value>> read(std::string_view /*text*/, std::type_identity<Object>) {
  return std::nullopt;
}

std::optional<FromText<Value>> read_number(std::string_view text) {
  auto whole = read(text, std::type_identity<std::int64_t>());
  return whole && !whole->has_rest ? whole : read(text, std::type_identity<double>());
}

std::optional<FromText<Value>> read(std::string_view text, std::type_identity<bool>) {
  const auto flag = read_item(text, Flag{});
  if (!flag) return std::nullopt;
  return FromText<Value>{Value(flag->value.is_set), false};
}

std::optional<FromText<Value>> read_object(const ObjectType* type, std::string_view text) {
  if (type == nullptr || !type->has_from_text()) return std::nullopt;
  auto made = type->from_text(text);
  if (!made) return std::nullopt;
  return FromText<Value>{Value(std::move(*made)), false};
}

// A number, whole or real; both empty: it is none.
struct Number {
  std::optional<std::int64_t> whole = {};
  std::optional<double> real = {};
};

Number number_of(const Value& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return {.whole = *flag ? 1 : 0};
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return {.whole = *whole};
  if (const auto* real = std::get_if<double>(&value)) return {.real = *real};
  return {};
}

template <class T>
std::optional<Value> as_value(std::optional<T> found) {
  if (!found) return std::nullopt;
  return Value(std::move(*found));
}

std::optional<Value> cast_number(const Number& number, const Value& value, ValueType type) {
  switch (type) {
    case ValueType::Number:
      return number.whole ? Value(*number.whole) : Value(*number.real);
    case ValueType::Bool:
      return as_value(to_condition(value));
    case ValueType::Int:
      return as_value(number.whole ? number.whole : to_whole(*number.real));
    case ValueType::Double:
      return as_value(number.real ? number.real : to_real(*number.whole));
    case ValueType::String: {
      std::string text;
      number.whole ? append_plain(*number.whole, text) : append_plain(*number.real, text);
      return Value(std::move(text));
    }
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<FromText<double>> number_from_text(std::string_view text) {
  return front_number<double>(text);
}

std::optional<FromText<Value>> value_from_text(ValueType type, const ObjectType* object,
                                               std::string_view text) {
  if (type == ValueType::Number) return read_number(text);
  if (type == ValueType::Object) return read_object(object, text);
  return with_type(type, [&](auto of) { return read(text, of); });
}

std::optional<double> to_real(std::int64_t number) {
  if (number > kLargestExact || number < -kLargestExact) return std::nullopt;
  return static_cast<double>(number);
}

std::optional<std::int64_t> to_whole(double number) {
  constexpr double kEnd = 9223372036854775808.0;  // 2^63
  if (!(number >= -kEnd && number < kEnd) || std::trunc(number) != number) return std::nullopt;
  return static_cast<std::int64_t>(number);
}

std::optional<bool> to_condition(const Value& value) {
  const Number number = number_of(value);
  if (number.whole && (*number.whole == 0 || *number.whole == 1)) return *number.whole == 1;
  if (number.real && !(*number.real < 0)) return *number.real != 0;
  return std::nullopt;
}

std::optional<Value> cast_value(const Value& value, ValueType type, const ObjectType* object) {
  const Number number = number_of(value);
  if (number.whole || number.real) return cast_number(number, value, type);
  if (!holds(value, type)) return std::nullopt;
  const auto* carried = std::get_if<Object>(&value);
  const bool is_other = carried != nullptr && carried->type() != nullptr && object != nullptr &&
                        carried->type()->name() != object->name();
  return is_other ? std::nullopt : std::optional(value);
}

std::optional<Value> convert_value(const Value& value, ValueType type, const ObjectType* object) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) return cast_value(value, type, object);
  auto read = value_from_text(type, object, *text);
  if (!read) return std::nullopt;
  return std::move(read->value);
}

void append_plain(std::int64_t number, std::string& out) {
  out += std::to_string(number);
}

void append_plain(double number, std::string& out) {
  out += fmt::format("{:f}", number);
}

}  // namespace lockstep::host
