// Statuses, texts as values, results, and what a node declares about its ports.
#pragma once

#include <charconv>
#include <chrono>
#include <cstdint>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>
#include <typeindex>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "behaviortree_cpp/contrib/expected.hpp"
#include "behaviortree_cpp/exceptions.h"
#include "behaviortree_cpp/lockstep/inline.h"
#include "behaviortree_cpp/lockstep/json_functions.h"
#include "behaviortree_cpp/lockstep/standard.h"
#include "behaviortree_cpp/utils/demangle_util.h"
#include "behaviortree_cpp/utils/safe_any.hpp"

namespace BT {

enum class NodeType { UNDEFINED = 0, ACTION, CONDITION, CONTROL, DECORATOR, SUBTREE };
enum class NodeStatus { IDLE = 0, RUNNING = 1, SUCCESS = 2, FAILURE = 3, SKIPPED = 4 };
enum class PortDirection { INPUT, OUTPUT, INOUT };

inline bool isStatusActive(const NodeStatus& status) {
  return status != NodeStatus::IDLE && status != NodeStatus::SKIPPED;
}
inline bool isStatusCompleted(const NodeStatus& status) {
  return status == NodeStatus::SUCCESS || status == NodeStatus::FAILURE;
}

using StringView = std::string_view;
using KeyValueVector = std::vector<std::pair<std::string, std::string>>;

template <class T>
using Expected = nonstd::expected<T, std::string>;
#ifdef USE_BTCPP3_OLD_NAMES
template <class T>
using Optional = nonstd::expected<T, std::string>;
#endif
using Result = Expected<std::monostate>;

using TimePoint = std::chrono::high_resolution_clock::time_point;
using Duration = std::chrono::high_resolution_clock::duration;

struct Timestamp {
  std::uint64_t seq = 0;  // how often the entry was written
  std::chrono::nanoseconds time{0};
};

// The type of a port that takes values of any type.
struct AnyTypeAllowed {};

inline bool StartWith(StringView text, StringView prefix) {
  return text.substr(0, prefix.size()) == prefix;
}
inline bool StartWith(StringView text, char prefix) {
  return !text.empty() && text.front() == prefix;
}

// The parts between the separators; one at the end gives no part.
std::vector<StringView> splitString(const StringView& text, char separator);

// A value as "json:…"; an error when its type has no text in JSON.
Expected<std::string> toJsonString(const Any& value);

namespace lockstep_detail {

[[noreturn]] void refuse_text(StringView text, const std::string& wanted);

// The number that a text begins with; the rest is ignored.
template <class T>
T number_from(StringView text) {
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  static_cast<void>(end);
  if (error == std::errc::result_out_of_range) {
    refuse_text(text, "in the range of " + readable(typeid(T)));
  }
  if (error != std::errc()) refuse_text(text, "a number");
  return number;
}

// Thrown by the convertFromString of a type that has none.
class NoConversion : public LogicError {
 public:
  using LogicError::LogicError;
};

template <class T>
struct TextReader {
  static T read(StringView text) {
    if constexpr (std::is_same_v<T, bool>) {
      for (const StringView word : {"1", "true", "TRUE", "True"}) {
        if (text == word) return true;
      }
      for (const StringView word : {"0", "false", "FALSE", "False"}) {
        if (text == word) return false;
      }
      refuse_text(text, "true or false");
    } else if constexpr (std::is_arithmetic_v<T>) {
      return number_from<T>(text);
    } else if constexpr (is_text_v<T>) {
      return T(text.data(), text.size());
    } else {
      if (StartWith(text, "json:")) {
        Any value;
        if (read_json(typeid(T), text.substr(5), value)) return value.cast<T>();
      }
      throw NoConversion("there is no conversion from a text to ", readable(typeid(T)),
                         "; specialize BT::convertFromString for it");
    }
  }
};
template <>
const char* TextReader<const char*>::read(StringView text);

}  // namespace lockstep_detail

// A text as a value; throws when it is none. Specialize it for the types of your ports.
template <typename T>
inline T convertFromString(StringView text) {
  return lockstep_detail::TextReader<T>::read(text);
}

// A text in JSON as a value of a type that is registered for it.
[[nodiscard]] Any convertFromJSON(StringView text, std::type_index type);
template <typename T>
[[nodiscard]] T convertFromJSON(StringView text) {
  return convertFromJSON(text, typeid(T)).cast<T>();
}

namespace lockstep_detail {

template <class Item>
struct TextReader<std::vector<Item>> {
  static std::vector<Item> read(StringView text) {
    if (StartWith(text, "json:")) {
      Any value;
      if (read_json(typeid(std::vector<Item>), text.substr(5), value)) {
        return value.cast<std::vector<Item>>();
      }
    }
    std::vector<Item> items;
    for (const StringView part : splitString(text, ';')) {
      items.push_back(convertFromString<Item>(part));
    }
    return items;
  }
};

template <class Enum, std::size_t kCount>
Enum named_value(StringView text, const char* const (&names)[kCount]) {
  for (std::size_t i = 0; i < kCount; ++i) {
    if (text == names[i]) return static_cast<Enum>(i);
  }
  refuse_text(text, readable(typeid(Enum)));
}

inline constexpr const char* kStatusNames[] = {"IDLE", "RUNNING", "SUCCESS", "FAILURE", "SKIPPED"};
inline constexpr const char* kTypeNames[] = {"Undefined", "Action",    "Condition",
                                             "Control",   "Decorator", "SubTree"};
inline constexpr const char* kDirectionNames[] = {"Input", "Output", "InOut"};

}  // namespace lockstep_detail

template <>
NodeStatus convertFromString<NodeStatus>(StringView text);
template <>
NodeType convertFromString<NodeType>(StringView text);
template <>
PortDirection convertFromString<PortDirection>(StringView text);

template <class T>
constexpr bool IsConvertibleToString() {
  return std::is_convertible_v<T, std::string> || std::is_convertible_v<T, std::string_view>;
}

// Specialize it for your types, or register them for JSON.
template <typename T>
[[nodiscard]] std::string toStr(const T& value) {
  if constexpr (IsConvertibleToString<T>()) {
    return static_cast<std::string>(value);
  } else if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return std::to_string(value);
  } else if constexpr (std::is_same_v<T, NodeStatus>) {
    return lockstep_detail::kStatusNames[static_cast<int>(value)];
  } else if constexpr (std::is_same_v<T, NodeType>) {
    return lockstep_detail::kTypeNames[static_cast<int>(value)];
  } else if constexpr (std::is_same_v<T, PortDirection>) {
    return lockstep_detail::kDirectionNames[static_cast<int>(value)];
  } else {
    if (auto text = toJsonString(Any(value))) return std::move(*text);
    throw LogicError("there is no text for a value of type ", lockstep_detail::readable(typeid(T)),
                     "; specialize BT::toStr for it, or register it for JSON");
  }
}
// With colors for a terminal.
[[nodiscard]] std::string toStr(NodeStatus status, bool colored);

std::ostream& operator<<(std::ostream& out, const NodeStatus& status);
std::ostream& operator<<(std::ostream& out, const NodeType& type);
std::ostream& operator<<(std::ostream& out, const PortDirection& direction);

using StringConverter = std::function<Any(StringView)>;

}  // namespace BT

#include "behaviortree_cpp/lockstep/ports.h"  // IWYU pragma: export

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/basic_types.h"  // IWYU pragma: export
#endif
