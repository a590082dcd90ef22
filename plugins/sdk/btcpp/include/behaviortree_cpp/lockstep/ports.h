// What a node declares about its ports. Included by basic_types.h.
#pragma once

#include <string>
#include <type_traits>
#include <typeindex>
#include <unordered_map>
#include <utility>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/lockstep/port_value.h"

namespace BT {

class TypeInfo {
 public:
  template <class T>
  static TypeInfo Create() {
    TypeInfo info;
    info.type_ = typeid(T);
    info.name_ = demangle(typeid(T));
    info.values_ = &lockstep_detail::PortValue<T>::kTable;
    return info;
  }
  TypeInfo() = default;
  // That of the number that is there; any for the rest.
  static TypeInfo lockstep_of_number(const Any& value) {
    return lockstep_first_of<int, double, bool, std::int64_t, std::uint64_t, float, unsigned,
                             std::int16_t, std::uint16_t, std::int8_t, std::uint8_t>(value);
  }

  const std::type_index& type() const { return type_; }
  const std::string& typeName() const { return name_; }
  bool isStronglyTyped() const { return type_ != typeid(AnyTypeAllowed) && type_ != typeid(Any); }
  // An empty value: there is no conversion.
  Any parseString(const std::string& text) const { return values_->parse(text); }
  StringConverter converter() const { return values_->parse; }

  const lockstep_detail::PortValues& lockstep_values() const { return *values_; }

 private:
  template <class... Types>
  static TypeInfo lockstep_first_of(const Any& value) {
    TypeInfo info;
    static_cast<void>(((value.type() == typeid(Types) && (info = Create<Types>(), true)) || ...));
    return info;
  }

  std::type_index type_ = typeid(AnyTypeAllowed);
  std::string name_ = "AnyTypeAllowed";
  const lockstep_detail::PortValues* values_ = &lockstep_detail::PortValue<AnyTypeAllowed>::kTable;
};

namespace lockstep_detail {
template <class T>
TypeInfo type_info_of() {
  return TypeInfo::Create<T>();
}
}  // namespace lockstep_detail

class PortInfo : public TypeInfo {
 public:
  explicit PortInfo(PortDirection direction = PortDirection::INOUT) : direction_(direction) {}
  PortInfo(PortDirection direction, const TypeInfo& type) : TypeInfo(type), direction_(direction) {}

  PortDirection direction() const { return direction_; }
  const std::string& description() const { return description_; }
  void setDescription(StringView text) { description_ = text; }
  // Empty: none.
  const Any& defaultValue() const { return default_; }
  const std::string& defaultValueString() const { return default_text_; }
  template <class T>
  void setDefaultValue(const T& value) {
    default_ = Any(value);
    if constexpr (std::is_floating_point_v<T>) {
      default_text_ = lockstep_detail::constant_text(value);  // all of its digits
    } else {
      try {
        default_text_ = toStr(value);
      } catch (const LogicError&) {
        default_text_.clear();
      }
    }
  }

 private:
  PortDirection direction_;
  std::string description_;
  Any default_;
  std::string default_text_;
};

using PortsList = std::unordered_map<std::string, PortInfo>;

// The attributes of every node.
[[nodiscard]] inline bool IsReservedAttribute(StringView name) {
  for (const StringView it : {"name", "ID", "_autoremap", "_failureIf", "_successIf", "_skipIf",
                              "_while", "_onHalted", "_onFailure", "_onSuccess", "_post"}) {
    if (name == it) return true;
  }
  return false;
}

// The first character that no name may have; '\0': there is none.
[[nodiscard]] inline char findForbiddenChar(StringView name) {
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f || StringView(" <>&\"'/\\:*?|.").find(c) != StringView::npos) {
      return c;
    }
  }
  return '\0';
}

[[nodiscard]] inline bool IsAllowedPortName(StringView name) {
  if (name.empty()) return false;
  const char first = static_cast<char>(name.front() | 0x20);
  return first >= 'a' && first <= 'z' && findForbiddenChar(name) == '\0' &&
         !IsReservedAttribute(name);
}

namespace lockstep_detail {

// Throws when it is none: the tree could not name it.
inline void check_port_name(StringView name) {
  if (IsAllowedPortName(name)) return;
  throw RuntimeError("'", name,
                     "' is not the name of a port: a letter first, no blanks, and none "
                     "of the characters <>&\"'/\\:*?|.");
}

template <class T>
std::pair<std::string, PortInfo> make_port(PortDirection direction, StringView name,
                                           StringView description) {
  check_port_name(name);
  PortInfo info(direction, TypeInfo::Create<T>());
  info.setDescription(description);
  return {std::string(name), std::move(info)};
}

template <class T, class Default>
std::pair<std::string, PortInfo> make_port(PortDirection direction, StringView name,
                                           const Default& value, StringView description) {
  static_assert(std::is_same_v<T, AnyTypeAllowed> || std::is_constructible_v<T, Default> ||
                    std::is_convertible_v<Default, std::string> ||
                    std::is_constructible_v<std::string, Default>,
                "the default of a port is a value of its type, or a text");
  auto port = make_port<T>(direction, name, description);
  // A text for a bool is no pointer.
  constexpr bool kIsText = std::is_constructible_v<std::string, Default> && std::is_arithmetic_v<T>;
  if constexpr (std::is_same_v<T, AnyTypeAllowed> || !std::is_constructible_v<T, Default> ||
                kIsText) {
    if constexpr (std::is_constructible_v<std::string, Default>) {
      port.second.setDefaultValue(std::string(value));
    } else {
      port.second.setDefaultValue(value);
    }
  } else {
    port.second.setDefaultValue(T(value));
  }
  return port;
}

}  // namespace lockstep_detail

// Throws when the name is none.
template <class T = AnyTypeAllowed>
std::pair<std::string, PortInfo> CreatePort(PortDirection direction, StringView name,
                                            StringView description = {}) {
  return lockstep_detail::make_port<T>(direction, name, description);
}
template <class T = AnyTypeAllowed>
[[nodiscard]] std::pair<std::string, PortInfo> InputPort(StringView name,
                                                         StringView description = {}) {
  return lockstep_detail::make_port<T>(PortDirection::INPUT, name, description);
}
template <class T = AnyTypeAllowed>
[[nodiscard]] std::pair<std::string, PortInfo> OutputPort(StringView name,
                                                          StringView description = {}) {
  return lockstep_detail::make_port<T>(PortDirection::OUTPUT, name, description);
}
template <class T = AnyTypeAllowed>
[[nodiscard]] std::pair<std::string, PortInfo> BidirectionalPort(StringView name,
                                                                 StringView description = {}) {
  return lockstep_detail::make_port<T>(PortDirection::INOUT, name, description);
}
// With a default: a value, a text that the type reads, or "{entry}".
template <class T = AnyTypeAllowed, class Default = T>
[[nodiscard]] std::pair<std::string, PortInfo> InputPort(StringView name, const Default& value,
                                                         StringView description) {
  return lockstep_detail::make_port<T>(PortDirection::INPUT, name, value, description);
}
template <class T = AnyTypeAllowed, class Default = T>
[[nodiscard]] std::pair<std::string, PortInfo> BidirectionalPort(StringView name,
                                                                 const Default& value,
                                                                 StringView description) {
  return lockstep_detail::make_port<T>(PortDirection::INOUT, name, value, description);
}
// The default of an output is an entry, "{key}".
template <class T = AnyTypeAllowed>
[[nodiscard]] std::pair<std::string, PortInfo> OutputPort(StringView name, StringView entry,
                                                          StringView description) {
  if (entry.size() < 3 || entry.front() != '{' || entry.back() != '}') {
    throw LogicError("the default of the output '", name, "' must be an entry, {key} or {=}");
  }
  auto port = lockstep_detail::make_port<T>(PortDirection::OUTPUT, name, description);
  port.second.setDefaultValue(std::string(entry));
  return port;
}

template <class T, class = void>
struct has_static_method_providedPorts : std::false_type {};
template <class T>
struct has_static_method_providedPorts<
    T, std::enable_if_t<std::is_same_v<decltype(T::providedPorts()), PortsList>>> : std::true_type {
};

template <class T, class = void>
struct has_static_method_metadata : std::false_type {};
template <class T>
struct has_static_method_metadata<
    T, std::enable_if_t<std::is_same_v<decltype(T::metadata()), KeyValueVector>>> : std::true_type {
};

template <class T>
PortsList getProvidedPorts() {
  if constexpr (has_static_method_providedPorts<T>::value) {
    return T::providedPorts();
  } else {
    return {};
  }
}

}  // namespace BT
