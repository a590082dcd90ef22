// Numbers as the C++ type that an entry has.
#pragma once

#include <cstdint>
#include <typeindex>

#include "behaviortree_cpp/utils/safe_any.hpp"

namespace BT::lockstep_detail {

// Empty: the type is none of a number, or has no such value.
template <class... Types>
Any number_of_types(std::type_index type, const Any& number) {
  Any found;
  const auto try_type = [&](auto held) {
    using T = decltype(held);
    if (type != typeid(T)) return false;
    if (const auto value = number.tryCast<T>()) found = Any(*value);
    return true;
  };
  static_cast<void>((try_type(Types{}) || ...));
  return found;
}
inline Any number_of(std::type_index type, const Any& number) {
  if (!number.isNumber()) return {};
  return number_of_types<int, double, bool, std::int64_t, std::uint64_t, float, unsigned,
                         std::int16_t, std::uint16_t, std::int8_t, std::uint8_t, long long,
                         unsigned long long, char>(type, number);
}

}  // namespace BT::lockstep_detail
