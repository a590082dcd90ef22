// The functions of json_functions.h. Included by it.
#pragma once

#include <charconv>
#include <cmath>
#include <string>

#include "behaviortree_cpp/exceptions.h"
#include "behaviortree_cpp/lockstep/json_functions.h"

namespace BT::lockstep_detail {

LOCKSTEP_BTCPP_INLINE std::map<std::type_index, JsonFunctions>& json_functions() {
  static std::map<std::type_index, JsonFunctions> all;
  return all;
}

LOCKSTEP_BTCPP_INLINE const JsonFunctions* find_json(std::type_index type) {
  const auto found = json_functions().find(type);
  return found == json_functions().end() ? nullptr : &found->second;
}

LOCKSTEP_BTCPP_INLINE bool read_json(std::type_index type, std::string_view text, Any& value) {
  const JsonFunctions* const functions = find_json(type);
  if (functions == nullptr || !functions->read) return false;
  try {
    functions->read(text, value);
  } catch (const std::exception& error) {
    throw RuntimeError("the JSON '", text, "' is no value of type ", readable(type), ": ",
                       error.what());
  }
  return true;
}

LOCKSTEP_BTCPP_INLINE std::string plain_json(const Any& value) {
  if (value.isNumber()) {
    std::string text = value.cast<std::string>();
    if (value.castedType() == typeid(double)) {
      char digits[64];
      const double number = value.cast<double>();
      if (!std::isfinite(number)) return "null";
      const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
      text.assign(digits, end);
      if (text.find_first_of(".e") == std::string::npos) text += ".0";
    }
    return text;
  }
  std::string text = "\"";
  for (const char c : value.cast<std::string>()) {
    if (c == '"' || c == '\\') text += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) {
      text += c;
    } else {
      constexpr char kHex[] = "0123456789abcdef";
      text += "\\u00";
      text += kHex[(c >> 4) & 0xf];
      text += kHex[c & 0xf];
    }
  }
  return text + '"';
}

}  // namespace BT::lockstep_detail
