// Which types have a text in JSON: json_export.h enters them, ports use them. Each shared object
// has its own table.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <typeindex>

#include "behaviortree_cpp/utils/safe_any.hpp"

namespace BT {
class TypeInfo;
}

namespace BT::lockstep_detail {

// Without `write` or `read` it is only read or only written.
struct JsonFunctions {
  std::string name;  // its "__type"
  bool is_list = false;
  TypeInfo (*type)() = nullptr;
  std::function<std::string(const void* value)> write;
  std::function<void(std::string_view text, Any& value)> read;  // throws: it is none
};

[[gnu::visibility("hidden")]] std::map<std::type_index, JsonFunctions>& json_functions();

const JsonFunctions* find_json(std::type_index type);

// False: the type has none. Throws if the text is no value of it, and says why.
bool read_json(std::type_index type, std::string_view text, Any& value);

// Numbers and texts.
std::string plain_json(const Any& value);

}  // namespace BT::lockstep_detail

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/json_functions.h"  // IWYU pragma: export
#endif
