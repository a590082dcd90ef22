// Which types have a text in JSON: json_export.h enters them, ports use them. Each shared object
// has its own table.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <typeindex>

#include "behaviortree_cpp/utils/safe_any.hpp"

namespace BT::detail {

struct JsonFunctions {
  void (*write)(const void* value, std::string& text);
  bool (*read)(std::string_view text, Any& value);  // false: it is none
};

[[gnu::visibility("hidden")]] inline std::map<std::type_index, JsonFunctions>& json_functions() {
  static std::map<std::type_index, JsonFunctions> all;
  return all;
}

inline const JsonFunctions* find_json(std::type_index type) {
  const auto found = json_functions().find(type);
  return found == json_functions().end() ? nullptr : &found->second;
}

// False: the type has none.
inline bool write_json(std::type_index type, const void* value, std::string& text) {
  const JsonFunctions* const functions = find_json(type);
  if (functions != nullptr) functions->write(value, text);
  return functions != nullptr;
}
// False: the type has none, or the text is no value of it.
inline bool read_json(std::type_index type, std::string_view text, Any& value) {
  const JsonFunctions* const functions = find_json(type);
  return functions != nullptr && functions->read(text, value);
}

}  // namespace BT::detail
