// The ports that a node declares. Included by basic_types.h.
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
    return {typeid(T), lockstep_detail::PortValue<T>::kTable};
  }
  TypeInfo();
  TypeInfo(const TypeInfo&);
  TypeInfo(TypeInfo&&) noexcept;
  TypeInfo& operator=(const TypeInfo&);
  TypeInfo& operator=(TypeInfo&&) noexcept;
  ~TypeInfo();
  // That of the number that is there; any for the rest.
  static TypeInfo lockstep_of_number(const Any& value);

  const std::type_index& type() const { return type_; }
  const std::string& typeName() const { return name_; }
  bool isStronglyTyped() const { return type_ != typeid(AnyTypeAllowed) && type_ != typeid(Any); }
  // An empty value: there is no conversion.
  Any parseString(const std::string& text) const { return values_->parse(text); }
  StringConverter converter() const { return values_->parse; }

  const lockstep_detail::PortValues& lockstep_values() const { return *values_; }

 private:
  TypeInfo(const std::type_info& type, const lockstep_detail::PortValues& values);
  template <class... Types>
  static TypeInfo lockstep_first_of(const Any& value) {
    TypeInfo info;
    static_cast<void>(((value.type() == typeid(Types) && (info = Create<Types>(), true)) || ...));
    return info;
  }

  std::type_index type_;
  std::string name_;
  const lockstep_detail::PortValues* values_;
};

namespace lockstep_detail {
template <class T>
TypeInfo type_info_of() {
  return TypeInfo::Create<T>();
}
}  // namespace lockstep_detail

class PortInfo : public TypeInfo {
 public:
  explicit PortInfo(PortDirection direction = PortDirection::INOUT);
  PortInfo(PortDirection direction, const TypeInfo& type);
  PortInfo(const PortInfo&);
  PortInfo(PortInfo&&) noexcept;
  PortInfo& operator=(const PortInfo&);
  PortInfo& operator=(PortInfo&&) noexcept;
  ~PortInfo();

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
[[nodiscard]] bool IsReservedAttribute(StringView name);

// The first character that no name may have; '\0': there is none.
[[nodiscard]] char findForbiddenChar(StringView name);

[[nodiscard]] bool IsAllowedPortName(StringView name);

namespace lockstep_detail {

// Throws when it is none: the tree could not name it.
void check_port_name(StringView name);

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

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/ports.h"  // IWYU pragma: export
#endif
