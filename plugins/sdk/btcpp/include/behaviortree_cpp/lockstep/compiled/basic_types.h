// The functions of basic_types.h. Included by it.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "behaviortree_cpp/basic_types.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE std::vector<StringView> splitString(const StringView& text, char separator) {
  std::vector<StringView> parts;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

LOCKSTEP_BTCPP_INLINE Expected<std::string> toJsonString(const Any& value) {
  if (value.isNumber() || value.isString()) return "json:" + lockstep_detail::plain_json(value);
  const lockstep_detail::JsonFunctions* const functions =
      lockstep_detail::find_json(value.castedType());
  if (functions == nullptr || !functions->write) {
    return nonstd::make_unexpected(StrCat(
        "values of type ", lockstep_detail::readable(value.type()), " have no text in JSON"));
  }
  return "json:" + functions->write(value.lockstep_object());
}

namespace lockstep_detail {

[[noreturn]] LOCKSTEP_BTCPP_INLINE void refuse_text(StringView text, const std::string& wanted) {
  throw RuntimeError("'", text, "' is not ", wanted);
}

template <>
LOCKSTEP_BTCPP_INLINE const char* TextReader<const char*>::read(StringView text) {
  return text.data();
}

}  // namespace lockstep_detail
LOCKSTEP_BTCPP_INLINE Any convertFromJSON(StringView text, std::type_index type) {
  Any value;
  if (!lockstep_detail::read_json(type, text, value)) {
    throw RuntimeError("the type ", lockstep_detail::readable(type),
                       " is not registered with BT::RegisterJsonDefinition");
  }
  return value;
}

template <>
LOCKSTEP_BTCPP_INLINE NodeStatus convertFromString<NodeStatus>(StringView text) {
  return lockstep_detail::named_value<NodeStatus>(text, lockstep_detail::kStatusNames);
}

template <>
LOCKSTEP_BTCPP_INLINE NodeType convertFromString<NodeType>(StringView text) {
  return lockstep_detail::named_value<NodeType>(text, lockstep_detail::kTypeNames);
}

template <>
LOCKSTEP_BTCPP_INLINE PortDirection convertFromString<PortDirection>(StringView text) {
  for (const StringView word : {"Input", "INPUT", "Output", "OUTPUT", "InOut", "INOUT"}) {
    if (text == word) {
      return word.front() == 'O'                           ? PortDirection::OUTPUT
             : word.size() == 5 && (word[2] & 0x5f) == 'P' ? PortDirection::INPUT
                                                           : PortDirection::INOUT;
    }
  }
  lockstep_detail::refuse_text(text, "a direction");
}

LOCKSTEP_BTCPP_INLINE std::string toStr(NodeStatus status, bool colored) {
  if (!colored) return toStr(status);
  constexpr const char* kColors[] = {"36", "33", "32", "31", "34"};
  return StrCat("\x1b[", kColors[static_cast<int>(status)], "m", toStr(status), "\x1b[0m");
}

LOCKSTEP_BTCPP_INLINE std::ostream& operator<<(std::ostream& out, const NodeStatus& status) {
  return out << toStr(status);
}

LOCKSTEP_BTCPP_INLINE std::ostream& operator<<(std::ostream& out, const NodeType& type) {
  return out << toStr(type);
}

LOCKSTEP_BTCPP_INLINE std::ostream& operator<<(std::ostream& out, const PortDirection& direction) {
  return out << toStr(direction);
}

}  // namespace BT
