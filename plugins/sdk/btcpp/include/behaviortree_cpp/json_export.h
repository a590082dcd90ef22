// Types with a text in JSON. A value of such a type has a text in recordings, may be written in a
// tree as json:{…}, and crosses to the process of an isolated plugin.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/contrib/json.hpp"

namespace BT {

// What the types of this shared object have for JSON.
class JsonExporter {
 public:
  using Entry = std::pair<Any, TypeInfo>;
  using ExpectedEntry = nonstd::expected<Entry, std::string>;

  static JsonExporter& get() {
    static JsonExporter exporter;
    return exporter;
  }

  // False: its type has none.
  bool toJson(const Any& value, nlohmann::json& json) const {
    const auto text = toJsonString(value);
    if (text) json = nlohmann::json::parse(text->substr(5));
    return text.has_value();
  }
  // An object as one of the type that its "__type" names.
  ExpectedEntry fromJson(const nlohmann::json& json) const {
    const nlohmann::json& first = json.is_array() && !json.empty() ? json.front() : json;
    const auto type = first.is_object() ? first.find("__type") : first.end();
    if (type == first.end() || !type->is_string()) {
      return nonstd::make_unexpected(std::string("Missing field '__type'"));
    }
    for (const auto& [index, functions] : lockstep_detail::json_functions()) {
      if (functions.name == *type && functions.is_list == json.is_array()) {
        return fromJson(json, index);
      }
    }
    return nonstd::make_unexpected(std::string("Type not found in registered list"));
  }
  ExpectedEntry fromJson(const nlohmann::json& json, std::type_index type) const {
    Entry entry;
    const lockstep_detail::JsonFunctions* const functions = lockstep_detail::find_json(type);
    if (functions == nullptr || !functions->read || !functions->read(json.dump(), entry.first)) {
      return nonstd::make_unexpected(
          StrCat("it is no value of type ", lockstep_detail::readable(type)));
    }
    entry.second = functions->type();
    return entry;
  }
  template <class T>
  Expected<T> fromJson(const nlohmann::json& json) const {
    const auto entry = fromJson(json, typeid(T));
    if (!entry) return nonstd::make_unexpected(entry.error());
    return entry->first.template tryCast<T>();
  }

  // A type with to_json and from_json, as BT_JSON_CONVERTER makes them.
  template <class T>
  void addConverter() {
    add_write<T>([](const T& value, nlohmann::json& json) { json = value; });
    add_read<T>([](const nlohmann::json& json, T& value) { json.get_to(value); });
  }
  template <class T>
  void addConverter(std::function<void(const T&, nlohmann::json&)> to_json, bool add_type = true) {
    add_write<T>([=](const T& value, nlohmann::json& json) {
      to_json(value, json);
      if (add_type) json["__type"] = demangle(typeid(T));
    });
  }
  template <class T>
  void addConverter(std::function<void(const nlohmann::json&, T&)> from_json) {
    add_read<T>(std::move(from_json));
  }

 private:
  JsonExporter() {
    addConverter<std::vector<double>>();
    addConverter<std::vector<int>>();
    addConverter<std::vector<bool>>();
    addConverter<std::vector<std::string>>();
  }

  template <class T>
  static lockstep_detail::JsonFunctions& functions_of(bool is_list = false) {
    lockstep_detail::JsonFunctions& functions = lockstep_detail::json_functions()[typeid(T)];
    functions.is_list = is_list;
    functions.type = TypeInfo::Create<T>;
    return functions;
  }
  template <class T>
  static void name(const nlohmann::json& json) {
    const auto type = json.is_object() ? json.find("__type") : json.end();
    const std::string name = type == json.end() ? demangle(typeid(T)) : std::string(*type);
    functions_of<T>().name = functions_of<std::vector<T>>(true).name = name;
  }

  template <class T, class Write>
  static void add_write(Write write_one) {
    functions_of<T>().write = [=](const void* value) {
      nlohmann::json json;
      write_one(*static_cast<const T*>(value), json);
      return json.dump();
    };
    functions_of<std::vector<T>>(true).write = [=](const void* values) {
      nlohmann::json list = nlohmann::json::array();
      for (const T& value : *static_cast<const std::vector<T>*>(values)) {
        write_one(value, list.emplace_back());
      }
      return list.dump();
    };
    nlohmann::json json;
    write_one(T{}, json);
    name<T>(json);
  }

  template <class T, class Read>
  static void add_read(Read read_one) {
    functions_of<T>().read = [=](std::string_view text, Any& any) {
      return reading(text, [&](const nlohmann::json& json) {
        T value{};
        read_one(json, value);
        any = Any(value);
      });
    };
    functions_of<std::vector<T>>(true).read = [=](std::string_view text, Any& any) {
      return reading(text, [&](const nlohmann::json& json) {
        std::vector<T> values;
        for (const nlohmann::json& it : json) read_one(it, values.emplace_back());
        any = Any(values);
      });
    };
    if (functions_of<T>().name.empty()) name<T>({});
  }
  template <class Read>
  static bool reading(std::string_view text, Read read) {
    try {
      read(nlohmann::json::parse(text));
    } catch (const std::exception&) {
      return false;
    }
    return true;
  }
};

// T, and lists of it, have a text in JSON from now on. Call it where the nodes are registered.
template <class T>
void RegisterJsonDefinition() {
  JsonExporter::get().addConverter<T>();
}

}  // namespace BT

// Says the fields of a class, in its namespace:
//   BT_JSON_CONVERTER(Point, point) { add_field("x", &point.x); add_field("y", &point.y); }
#define BT_JSON_CONVERTER(Type, value)                                                         \
  template <class AddField>                                                                    \
  void _JsonTypeDefinition(Type&, AddField&);                                                  \
  inline void to_json(nlohmann::json& json, const Type& from) {                                \
    const auto add = [&json](const char* name, auto* field) { json[name] = *field; };          \
    _JsonTypeDefinition(const_cast<Type&>(from), add);                                         \
    json["__type"] = #Type;                                                                    \
  }                                                                                            \
  inline void from_json(const nlohmann::json& json, Type& to) {                                \
    const auto add = [&json](const char* name, auto* field) { json.at(name).get_to(*field); }; \
    _JsonTypeDefinition(to, add);                                                              \
  }                                                                                            \
  template <class AddField>                                                                    \
  inline void _JsonTypeDefinition(Type& value, AddField& add_field)
