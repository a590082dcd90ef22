// Code that is the same for each type of values follows from the list of them, the alternatives of
// Value. So a type that is added there needs no line in it.
#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/core/value.h"

namespace lockstep::host {

// The type whose values are of type T.
template <class T, std::size_t kIndex = 1>
constexpr ValueType value_type_of() {
  if constexpr (std::is_same_v<T, std::variant_alternative_t<kIndex, Value>>) {
    return static_cast<ValueType>(kIndex);
  } else {
    return value_type_of<T, kIndex + 1>();
  }
}

// An item of the lists of values, for one of C: their memory looks the same.
template <class T>
using ItemOf = std::conditional_t<std::is_same_v<T, bool>, Flag, T>;

// Calls `use` with std::type_identity<T> for the alternative T of Value with that number; NoValue
// if there is none.
template <std::size_t kIndex = 1, class Use>
constexpr auto with_alternative(std::size_t number, const Use& use) {
  if constexpr (kIndex == std::variant_size_v<Value>) {
    return use(std::type_identity<NoValue>());
  } else if (number == kIndex) {
    return use(std::type_identity<std::variant_alternative_t<kIndex, Value>>());
  } else {
    return with_alternative<kIndex + 1>(number, use);
  }
}

// The same for the values of a type; NoValue for Number, which has two.
template <class Use>
constexpr auto with_type(ValueType type, const Use& use) {
  return with_alternative(static_cast<std::size_t>(type), use);
}

// True for the numbers: 1 and 0.5, not true, which is a number for C++.
template <class T>
concept IsNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

template <class T>
constexpr bool kHasNumbers = IsNumber<T>;
template <class Item>
constexpr bool kHasNumbers<std::vector<Item>> = IsNumber<Item>;

// Numbers and lists of numbers, which may have a range.
inline bool has_numbers(ValueType type) {
  return type == ValueType::Number ||
         with_type(type, []<class T>(std::type_identity<T>) { return kHasNumbers<T>; });
}

}  // namespace lockstep::host
