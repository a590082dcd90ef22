// Values of ports, as the host has them and as a C++ type has them. Included by basic_types.h.
#pragma once

#include <lockstep/value_types.h>

#include <charconv>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/lockstep/object.h"
#include "behaviortree_cpp/lockstep/place.h"

namespace BT {
struct AnyTypeAllowed;
}

namespace BT::lockstep_detail {

// A list of such items, as C++ for BehaviorTree.CPP has it: its whole numbers are ints.
template <class Item>
using ListOf = std::vector<std::conditional_t<std::is_same_v<Item, std::int64_t>, int, Item>>;

// How the host has a list that is a T; an object: not as a list.
template <class T>
constexpr lockstep_type list_type() {
// NOLINTBEGIN(bugprone-macro-parentheses): it is a type
#define LOCKSTEP_ROW(TYPE, of_type, Item) \
  if (std::is_same_v<T, ListOf<Item>>) return LOCKSTEP_##TYPE;
  LOCKSTEP_LIST_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
  // NOLINTEND(bugprone-macro-parentheses)
  return std::is_same_v<T, std::vector<std::string>> ? LOCKSTEP_STRING_LIST : LOCKSTEP_OBJECT;
}

// The list of the host that a T is, and its functions.
template <class T>
using HostList =
    std::conditional_t<std::is_same_v<T, std::vector<int>>, std::vector<std::int64_t>, T>;
template <class T>
using HostListTraits = lockstep::detail::PortTraits<HostList<T>>;

// How the host has values of type T. An enum may be a number or a name, so its ports take both.
template <class T>
constexpr lockstep_type port_type() {
  if constexpr (std::is_same_v<T, bool>) {
    return LOCKSTEP_BOOL;
  } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, AnyTypeAllowed> ||
                       std::is_same_v<T, Any>) {
    return LOCKSTEP_ANY;
  } else if constexpr (std::is_integral_v<T>) {
    return LOCKSTEP_INT;
  } else if constexpr (std::is_floating_point_v<T>) {
    return LOCKSTEP_DOUBLE;
  } else if constexpr (is_text_v<T>) {
    return LOCKSTEP_STRING;
  } else {
    return list_type<T>();
  }
}

// A number as the host reads it back.
template <class T>
std::string constant_text(T value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else {
    char text[64];
    const auto [end, error] = std::to_chars(text, text + sizeof text, value);
    return error == std::errc() ? std::string(text, end) : std::string();
  }
}

template <class T>
const lockstep_object_type* object_type_of() {
  if constexpr (port_type<T>() == LOCKSTEP_OBJECT) {
    return object_type<T>();
  } else {
    return nullptr;
  }
}

template <class T>
bool get_list(const Place& place, std::uint32_t port, T& value) {
  typename HostListTraits<T>::View items;
  const lockstep::detail::Caller caller{place.host, place.caller};
  if (!HostListTraits<T>::get(caller, port, items)) return false;
  value.clear();
  for (const auto item : items) value.push_back(static_cast<typename T::value_type>(item));
  return true;
}

// The value of a port that the host has as a T; false: it has none.
template <class T>
bool get(const Place& place, std::uint32_t port, T& value) {
  constexpr lockstep_type kType = port_type<T>();
  const lockstep_host& host = *place.host;
  if constexpr (kType == LOCKSTEP_BOOL) {
    return host.get_bool(place.caller, port, &value);
  } else if constexpr (kType == LOCKSTEP_INT) {
    std::int64_t whole = 0;
    return host.get_int(place.caller, port, &whole) && convert_number(whole, value);
  } else if constexpr (kType == LOCKSTEP_DOUBLE) {
    double number = 0;
    if (!host.get_double(place.caller, port, &number)) return false;
    value = static_cast<T>(number);
    return true;
  } else if constexpr (kType == LOCKSTEP_STRING) {
    const char* text = nullptr;
    std::size_t length = 0;
    if (!host.get_string(place.caller, port, &text, &length)) return false;
    if constexpr (std::is_pointer_v<T>) {
      value = text;
    } else {
      value = T(text, length);
    }
    return true;
  } else if constexpr (list_type<T>() != LOCKSTEP_OBJECT) {
    return get_list(place, port, value);
  } else if constexpr (kType == LOCKSTEP_OBJECT) {
    void* object = nullptr;
    if (!host.get_object(place.caller, port, &object) &&
        !place.node->get_object(place.caller, port, object_type<T>(), &object)) {
      return false;
    }
    value = *static_cast<const lockstep::detail::ObjectHolder<T>*>(object)->value;
    return true;
  } else {
    return false;
  }
}

// False: the host does not take it.
template <class T>
bool set(const Place& place, std::uint32_t port, const T& value) {
  constexpr lockstep_type kType = port_type<T>();
  const lockstep_host& host = *place.host;
  if constexpr (kType == LOCKSTEP_BOOL) {
    return host.set_bool(place.caller, port, value);
  } else if constexpr (kType == LOCKSTEP_INT || std::is_enum_v<T>) {
    std::int64_t whole = 0;
    if constexpr (std::is_enum_v<T>) {
      whole = static_cast<std::int64_t>(value);
    } else if (!convert_number(value, whole)) {
      return false;
    }
    return host.set_int(place.caller, port, whole);
  } else if constexpr (kType == LOCKSTEP_DOUBLE) {
    return host.set_double(place.caller, port, static_cast<double>(value));
  } else if constexpr (kType == LOCKSTEP_STRING) {
    const std::string_view text(value);
    return host.set_string(place.caller, port, text.data(), text.size());
  } else if constexpr (list_type<T>() != LOCKSTEP_OBJECT) {
    const lockstep::detail::Caller caller{place.host, place.caller};
    if constexpr (std::is_same_v<T, HostList<T>>) {
      return HostListTraits<T>::set(caller, port, value);
    } else {
      return HostListTraits<T>::set(caller, port, HostList<T>(value.begin(), value.end()));
    }
  } else if constexpr (kType == LOCKSTEP_OBJECT) {
    void* const object = ObjectCalls<T>::made_from(value);
    const bool is_set = host.set_object(place.caller, port, object) ||
                        place.node->set_object(place.caller, port, object_type<T>(), object);
    ObjectCalls<T>::Common::release(object);
    return is_set;
  } else {
    return false;
  }
}

template <class T>
bool store_object(const Place& place, std::uint32_t port, const void* value) {
  return set(place, port, *static_cast<const T*>(value));
}

// A text as a T.
template <class T>
Expected<T> parse(StringView text) {
  try {
    return convertFromString<T>(text);
  } catch (const std::exception& error) {
    return nonstd::make_unexpected(std::string(error.what()));
  }
}

// The same of an enum: a name that the plugin has registered, or a number, comes first.
template <class T>
Expected<T> parse_with(StringView text, const std::unordered_map<std::string, int>* enums) {
  if constexpr (std::is_same_v<T, Any>) {
    return Any(text);
  } else if constexpr (std::is_enum_v<T> && !std::is_same_v<T, NodeStatus>) {
    if (enums != nullptr) {
      const auto found = enums->find(std::string(text));
      if (found != enums->end()) return static_cast<T>(found->second);
    }
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size()) return static_cast<T>(number);
    return parse<T>(text);
  } else {
    return parse<T>(text);
  }
}

// An object of a type that this shared object knows.
bool get_any_object(const Place& place, std::uint32_t port, Any& value);

// A value that is no text, as its type says.
bool get_any(const Place& place, std::uint32_t port, lockstep_type type, Any& value);

// The functions for values of a port whose type is known by its declaration only.
struct PortValues {
  lockstep_type type;
  const lockstep_object_type* (*object)();
  Any (*parse)(StringView text);
  bool (*get)(const Place& place, std::uint32_t port, Any& value);
  bool (*set)(const Place& place, std::uint32_t port, const Any& value);
};

// Into a port of any type, as the type that is inside.
bool set_any(const Place& place, std::uint32_t port, const Any& any);

template <class T>
struct PortValue {
  static Any parse(StringView text) {
    if constexpr (std::is_same_v<T, AnyTypeAllowed> || std::is_same_v<T, Any>) {
      return Any(std::string(text));
    } else {
      try {
        return Any(convertFromString<T>(text));
      } catch (const NoConversion&) {
        return Any();
      }
    }
  }
  static bool get(const Place& place, std::uint32_t port, Any& any) {
    if constexpr (port_type<T>() == LOCKSTEP_ANY) {
      return false;
    } else if constexpr (!std::is_default_constructible_v<T>) {
      return get_any_object(place, port, any);
    } else {
      T value{};
      if (!lockstep_detail::get(place, port, value)) return false;
      any = Any(value);
      return true;
    }
  }
  static bool set(const Place& place, std::uint32_t port, const Any& any) {
    if constexpr (std::is_same_v<T, AnyTypeAllowed> || std::is_same_v<T, Any>) {
      return set_any(place, port, any);
    } else {
      const auto value = any.tryCast<std::conditional_t<is_text_v<T>, std::string, T>>();
      return value && lockstep_detail::set(place, port, *value);
    }
  }
  static constexpr PortValues kTable{port_type<T>(), object_type_of<T>, parse, get, set};
};

}  // namespace BT::lockstep_detail

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/port_value.h"  // IWYU pragma: export
#endif
