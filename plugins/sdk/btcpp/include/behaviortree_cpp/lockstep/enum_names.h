// The names of an enum's values, from the compiler.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace BT::lockstep_detail {

// "" for a number that has no name.
template <class Enum, Enum kValue>
constexpr std::string_view name_of_value() {
  constexpr std::string_view kFunction = __PRETTY_FUNCTION__;  // "… kValue = ns::Color::Red]"
  constexpr std::string_view kMark = "kValue = ";
  std::string_view name = kFunction.substr(kFunction.find(kMark) + kMark.size());
  name = name.substr(0, name.find_first_of(";]"));
  if (name.empty() || name[0] == '(' || name[0] == '-' || (name[0] >= '0' && name[0] <= '9')) {
    return {};
  }
  const auto colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

// Calls `function(name, value)` for each value from -128 to 127 that has a name.
template <class Enum, class Function, std::size_t... kIndex>
void for_each_name(Function function, std::index_sequence<kIndex...>) {
  const auto call = [&](std::string_view name, int value) {
    if (!name.empty()) function(name, value);
  };
  (call(name_of_value<Enum, static_cast<Enum>(static_cast<int>(kIndex) - 128)>(),
        static_cast<int>(kIndex) - 128),
   ...);
}
template <class Enum, class Function>
void for_each_name(Function function) {
  for_each_name<Enum>(function, std::make_index_sequence<256>());
}

}  // namespace BT::lockstep_detail
