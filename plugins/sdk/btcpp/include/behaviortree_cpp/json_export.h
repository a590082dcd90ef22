// Types with a text in JSON. A value of such a type has a text in recordings, may be written in a
// tree as json:{…}, and crosses to the process of an isolated plugin.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/lockstep/json_text.h"

namespace BT::detail {

template <class T>
struct is_vector : std::false_type {};
template <class Item>
struct is_vector<std::vector<Item>> : std::true_type {};

struct JsonWriter;
struct JsonReader;

// What the fields of a class are said to; BT_JSON_CONVERTER says them.
struct NoField {
  template <class Field>
  void operator()(const char*, Field*) {}
};
template <class T, class = void>
inline constexpr bool has_json_fields = false;
template <class T>
inline constexpr bool has_json_fields<
    T, std::void_t<decltype(_JsonTypeDefinition(std::declval<T&>(), std::declval<NoField&>()))>> =
    true;

struct JsonWriter {
  std::string& out;
  bool is_first = true;

  template <class Field>
  void operator()(const char* name, Field* field) {
    if (!std::exchange(is_first, false)) out += ',';
    write_json_text(name, out);
    out += ':';
    write(*field, out);
  }

  template <class T>
  static void write(const T& value, std::string& out) {
    if constexpr (is_text_v<T>) {
      write_json_text(value, out);
    } else if constexpr (std::is_enum_v<T>) {
      out += std::to_string(static_cast<std::int64_t>(value));
    } else if constexpr (std::is_floating_point_v<T>) {
      out += std::isfinite(value) ? constant_text(value) : "null";
    } else if constexpr (std::is_arithmetic_v<T>) {
      out += constant_text(value);
    } else if constexpr (is_vector<T>::value) {
      out += '[';
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (i != 0) out += ',';
        write<typename T::value_type>(value[i], out);
      }
      out += ']';
    } else {
      static_assert(has_json_fields<T>,
                    "this type has no fields for JSON: say them with BT_JSON_CONVERTER(Type, it) { "
                    "add_field(\"x\", &it.x); } in the namespace of the type");
      out += '{';
      JsonWriter fields{out};
      _JsonTypeDefinition(const_cast<T&>(value), fields);  // NOLINT: it takes addresses only
      out += '}';
    }
  }
};

struct JsonReader {
  const JsonNode& node;
  bool is_good = true;

  template <class Field>
  void operator()(const char* name, Field* field) {
    const JsonNode* const found = node.find(name);
    is_good = is_good && found != nullptr && read(*found, *field);
  }

  // False: it is no value of the type.
  template <class T>
  static bool read(const JsonNode& from, T& value) {
    using Kind = JsonNode::Kind;
    if constexpr (std::is_same_v<T, std::string>) {
      value = from.text;
      return from.kind == Kind::Text;
    } else if constexpr (std::is_same_v<T, bool>) {
      value = from.flag;
      return from.kind == Kind::Bool;
    } else if constexpr (std::is_enum_v<T>) {
      std::int64_t number = 0;
      if (!read(from, number)) return false;
      value = static_cast<T>(number);
      return true;
    } else if constexpr (std::is_arithmetic_v<T>) {
      const char* const end = from.text.data() + from.text.size();
      const auto [rest, error] = std::from_chars(from.text.data(), end, value);
      return from.kind == Kind::Number && error == std::errc() && rest == end;
    } else if constexpr (is_vector<T>::value) {
      value.clear();
      for (const JsonNode& item : from.items) {
        typename T::value_type read_item{};
        if (!read(item, read_item)) return false;
        value.push_back(std::move(read_item));
      }
      return from.kind == Kind::List;
    } else {
      JsonReader fields{from};
      _JsonTypeDefinition(value, fields);
      return from.kind == Kind::Object && fields.is_good;
    }
  }
};

template <class T>
void register_json() {
  JsonFunctions functions{};
  functions.write = [](const void* value, std::string& text) {
    JsonWriter::write(*static_cast<const T*>(value), text);
  };
  functions.read = [](std::string_view text, Any& any) {
    JsonNode node;
    T value{};
    if (!JsonParser::parse(text, node) || !JsonReader::read(node, value)) return false;
    any = Any(value);
    return true;
  };
  json_functions()[typeid(T)] = functions;
}

}  // namespace BT::detail

namespace BT {

// T, and lists of it, have a text in JSON from now on. Call it where the nodes are registered.
template <class T>
void RegisterJsonDefinition() {
  detail::register_json<T>();
  if constexpr (!detail::is_vector<T>::value) detail::register_json<std::vector<T>>();
}

}  // namespace BT

// Says the fields of a class, in its namespace:
//   BT_JSON_CONVERTER(Point, point) { add_field("x", &point.x); add_field("y", &point.y); }
#define BT_JSON_CONVERTER(Type, value) \
  template <class AddField>            \
  inline void _JsonTypeDefinition(Type& value, AddField& add_field)
