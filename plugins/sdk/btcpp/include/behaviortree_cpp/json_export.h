// Types with a text in JSON. A value of such a type has a text in recordings, may be written in a
// tree as json:{…}, and crosses to the process of an isolated plugin.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "behaviortree_cpp/blackboard.h"
#include "behaviortree_cpp/contrib/json.hpp"

namespace BT {
namespace lockstep_detail {

// nlohmann::json where it is used: what does not depend on a parameter of a template is compiled in
// each source that includes this.
template <class>
struct JsonOf {
  using Type = nlohmann::json;
};
template <class T>
using Json = typename JsonOf<T>::Type;

}  // namespace lockstep_detail

// The conversions between JSON and the types of this shared object.
class JsonExporter {
 public:
  using Entry = std::pair<Any, TypeInfo>;
  using ExpectedEntry = nonstd::expected<Entry, std::string>;

  template <class T = void>
  static JsonExporter& get() {
    static JsonExporter& exporter = lockstep_make<T>();
    return exporter;
  }

  // False: its type has none.
  template <class T = void>
  bool toJson(const Any& value, nlohmann::json& json) const {
    const auto text = toJsonString(value);
    if (text) json = lockstep_detail::Json<T>::parse(text->substr(5));
    return text.has_value();
  }
  // A number, a flag, a text or a list of these; an object as one of the type that its "__type"
  // names.
  template <class T = void>
  std::enable_if_t<std::is_void_v<T>, ExpectedEntry> fromJson(const nlohmann::json& json) const {
    return lockstep_entry_from<lockstep_detail::Json<T>>(json);
  }
  template <class T = void>
  ExpectedEntry fromJson(const nlohmann::json& json, std::type_index type) const {
    return lockstep_entry_as<lockstep_detail::Json<T>>(json, type);
  }
  template <class T>
  std::enable_if_t<!std::is_void_v<T>, Expected<T>> fromJson(const nlohmann::json& json) const {
    const auto entry = lockstep_entry_as<lockstep_detail::Json<T>>(json, typeid(T));
    if (!entry) return nonstd::make_unexpected(entry.error());
    return entry->first.template tryCast<T>();
  }

  // A type with to_json and from_json, as BT_JSON_CONVERTER makes them.
  template <class T>
  void addConverter() {
    using Json = lockstep_detail::Json<T>;
    add_write<T>([](const T& value, Json& json) { json = value; });
    add_read<T>([](const Json& json, T& value) { json.get_to(value); });
  }
  template <class T>
  void addConverter(std::function<void(const T&, nlohmann::json&)> to_json, bool add_type = true) {
    add_write<T>([=](const T& value, lockstep_detail::Json<T>& json) {
      to_json(value, json);
      if (add_type) json["__type"] = demangle(typeid(T));
    });
  }
  template <class T>
  void addConverter(std::function<void(const nlohmann::json&, T&)> from_json) {
    add_read<T>(std::move(from_json));
  }

 private:
  template <class T>
  static Entry entry_of(const T& value) {
    return {Any(value), TypeInfo::Create<T>()};
  }

  JsonExporter() = default;

  template <class T>
  static JsonExporter& lockstep_make() {
    static JsonExporter exporter;
    exporter.lockstep_add_lists<lockstep_detail::Json<T>, double, int, bool, std::string>();
    return exporter;
  }
  template <class Json, class... Items>
  void lockstep_add_lists() {
    (addConverter<std::vector<Items>>(), ...);
  }

  template <class Json>
  ExpectedEntry lockstep_entry_from(const Json& json) const {
    if (json.is_boolean()) return entry_of(json.template get<bool>());
    if (json.is_number_integer()) return entry_of(json.template get<std::int64_t>());
    if (json.is_number_float()) return entry_of(json.template get<double>());
    if (json.is_string()) return entry_of(json.template get<std::string>());
    const Json& first = json.is_array() && !json.empty() ? json.front() : json;
    if (json.is_array()) {
      if (first.is_boolean()) return lockstep_entry_as(json, typeid(std::vector<bool>));
      if (first.is_number_integer()) return lockstep_entry_as(json, typeid(std::vector<int>));
      if (first.is_number_float()) return lockstep_entry_as(json, typeid(std::vector<double>));
      if (first.is_string()) return lockstep_entry_as(json, typeid(std::vector<std::string>));
    }
    const auto type = first.is_object() ? first.find("__type") : first.end();
    if (type == first.end() || !type->is_string()) {
      return nonstd::make_unexpected(std::string("Missing field '__type'"));
    }
    const auto name = type->template get<std::string>();
    for (const auto& [index, functions] : lockstep_detail::json_functions()) {
      if (functions.name == name && functions.is_list == json.is_array()) {
        return lockstep_entry_as(json, index);
      }
    }
    return nonstd::make_unexpected(std::string("Type not found in registered list"));
  }
  template <class Json>
  ExpectedEntry lockstep_entry_as(const Json& json, std::type_index type) const {
    Entry entry;
    const lockstep_detail::JsonFunctions* const functions = lockstep_detail::find_json(type);
    try {
      if (!lockstep_detail::read_json(type, json.dump(), entry.first)) {
        return nonstd::make_unexpected(
            StrCat("it is no value of type ", lockstep_detail::readable(type)));
      }
    } catch (const RuntimeError& error) {
      return nonstd::make_unexpected(std::string(error.what()));
    }
    entry.second = functions->type();
    return entry;
  }

  template <class T>
  static lockstep_detail::JsonFunctions& functions_of(bool is_list = false) {
    lockstep_detail::JsonFunctions& functions = lockstep_detail::json_functions()[typeid(T)];
    functions.is_list = is_list;
    functions.type = TypeInfo::Create<T>;
    return functions;
  }
  template <class T>
  static void name(const lockstep_detail::Json<T>& json) {
    const auto type = json.is_object() ? json.find("__type") : json.end();
    const std::string name = type == json.end() ? demangle(typeid(T)) : std::string(*type);
    functions_of<T>().name = functions_of<std::vector<T>>(true).name = name;
  }

  template <class T, class Write>
  static void add_write(Write write_one) {
    using Json = lockstep_detail::Json<T>;
    functions_of<T>().write = [=](const void* value) {
      Json json;
      write_one(*static_cast<const T*>(value), json);
      return json.dump();
    };
    functions_of<std::vector<T>>(true).write = [=](const void* values) {
      Json list = Json::array();
      for (const T& value : *static_cast<const std::vector<T>*>(values)) {
        write_one(value, list.emplace_back());
      }
      return list.dump();
    };
    Json json;
    write_one(T{}, json);
    name<T>(json);
  }

  template <class T, class Read>
  static void add_read(Read read_one) {
    using Json = lockstep_detail::Json<T>;
    functions_of<T>().read = [=](std::string_view text, Any& any) {
      T value{};
      read_one(Json::parse(text), value);
      any = Any(value);
    };
    functions_of<std::vector<T>>(true).read = [=](std::string_view text, Any& any) {
      std::vector<T> values;
      for (const Json& it : Json::parse(text)) read_one(it, values.emplace_back());
      any = Any(values);
    };
    if (functions_of<T>().name.empty()) name<T>({});
  }
};

// T, and lists of it, have a text in JSON from now on. Call it where the nodes are registered.
template <class T>
void RegisterJsonDefinition() {
  JsonExporter::get().addConverter<T>();
}

// The entries of a board with values that have a text in JSON, by their keys; null: it has none.
template <class Board>
[[nodiscard]] lockstep_detail::Json<Board> ExportBlackboardToJSON(const Board& blackboard) {
  lockstep_detail::Json<Board> all;
  for (const std::string& key : blackboard.template getKeys<std::string>()) {
    const auto content = std::as_const(blackboard).getAnyLocked(key);
    const Any* const value = std::as_const(content).get();
    if (value == nullptr || value->empty()) continue;
    lockstep_detail::Json<Board> json;
    if (value->isType<bool>()) {
      all[key] = value->cast<bool>();
    } else if (JsonExporter::get().toJson(*value, json)) {
      all[key] = std::move(json);
    }
  }
  return all;
}
// Sets the entries that it names; one that is not there is made, of the type that the JSON has.
template <class Board>
void ImportBlackboardFromJSON(const lockstep_detail::Json<Board>& json, Board& blackboard) {
  for (const auto& [key, value] : json.items()) {
    if (const auto entry = JsonExporter::get().fromJson(value)) {
      lockstep_detail::note_opening<Board>();
      blackboard.lockstep_store(key, entry->first, entry->second);
    }
  }
}

// The same of all boards of a BT::Tree, by the names of its subtrees.
template <class AnyTree>
[[nodiscard]] lockstep_detail::Json<AnyTree> ExportTreeToJSON(const AnyTree& tree) {
  lockstep_detail::Json<AnyTree> all;
  for (const auto& subtree : tree.subtrees) {
    all[subtree->instance_name.empty() ? subtree->tree_ID : subtree->instance_name] =
        ExportBlackboardToJSON(*subtree->blackboard);
  }
  return all;
}
// Throws when it is of a tree with other boards.
template <class AnyTree>
void ImportTreeFromJSON(const lockstep_detail::Json<AnyTree>& json, AnyTree& tree) {
  for (const auto& subtree : tree.subtrees) {
    const std::string& name =
        subtree->instance_name.empty() ? subtree->tree_ID : subtree->instance_name;
    if (!json.contains(name)) {
      throw LogicError("ImportTreeFromJSON: the JSON has no board of '", name, "'");
    }
    ImportBlackboardFromJSON(json.at(name), *subtree->blackboard);
  }
}

}  // namespace BT

// Says the fields of a class, in its namespace:
//   BT_JSON_CONVERTER(Point, point) { add_field("x", &point.x); add_field("y", &point.y); }
// NOLINTBEGIN(bugprone-macro-parentheses): they are names
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
// NOLINTEND(bugprone-macro-parentheses)
