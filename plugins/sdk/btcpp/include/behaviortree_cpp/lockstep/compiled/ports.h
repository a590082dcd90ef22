// The functions of ports.h. Included by it.
#pragma once

#include "behaviortree_cpp/lockstep/ports.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE TypeInfo::TypeInfo()
    : type_(typeid(AnyTypeAllowed)),
      name_("AnyTypeAllowed"),
      values_(&lockstep_detail::PortValue<AnyTypeAllowed>::kTable) {}
LOCKSTEP_BTCPP_INLINE TypeInfo::TypeInfo(const std::type_info& type,
                                         const lockstep_detail::PortValues& values)
    : type_(type), name_(demangle(type)), values_(&values) {}
LOCKSTEP_BTCPP_INLINE TypeInfo::TypeInfo(const TypeInfo&) = default;
LOCKSTEP_BTCPP_INLINE TypeInfo::TypeInfo(TypeInfo&&) noexcept = default;
LOCKSTEP_BTCPP_INLINE TypeInfo& TypeInfo::operator=(const TypeInfo&) = default;
LOCKSTEP_BTCPP_INLINE TypeInfo& TypeInfo::operator=(TypeInfo&&) noexcept = default;
LOCKSTEP_BTCPP_INLINE TypeInfo::~TypeInfo() = default;
LOCKSTEP_BTCPP_INLINE TypeInfo TypeInfo::lockstep_of_number(const Any& value) {
  return lockstep_first_of<int, double, bool, std::int64_t, std::uint64_t, float, unsigned,
                           std::int16_t, std::uint16_t, std::int8_t, std::uint8_t>(value);
}

LOCKSTEP_BTCPP_INLINE PortInfo::PortInfo(PortDirection direction) : direction_(direction) {}
LOCKSTEP_BTCPP_INLINE PortInfo::PortInfo(PortDirection direction, const TypeInfo& type)
    : TypeInfo(type), direction_(direction) {}
LOCKSTEP_BTCPP_INLINE PortInfo::PortInfo(const PortInfo&) = default;
LOCKSTEP_BTCPP_INLINE PortInfo::PortInfo(PortInfo&&) noexcept = default;
LOCKSTEP_BTCPP_INLINE PortInfo& PortInfo::operator=(const PortInfo&) = default;
LOCKSTEP_BTCPP_INLINE PortInfo& PortInfo::operator=(PortInfo&&) noexcept = default;
LOCKSTEP_BTCPP_INLINE PortInfo::~PortInfo() = default;

LOCKSTEP_BTCPP_INLINE bool IsReservedAttribute(StringView name) {
  for (const StringView it : {"name", "ID", "_autoremap", "_failureIf", "_successIf", "_skipIf",
                              "_while", "_onHalted", "_onFailure", "_onSuccess", "_post"}) {
    if (name == it) return true;
  }
  return false;
}

LOCKSTEP_BTCPP_INLINE char findForbiddenChar(StringView name) {
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f || StringView(" <>&\"'/\\:*?|.").find(c) != StringView::npos) {
      return c;
    }
  }
  return '\0';
}

LOCKSTEP_BTCPP_INLINE bool IsAllowedPortName(StringView name) {
  if (name.empty()) return false;
  const char first = static_cast<char>(name.front() | 0x20);
  return first >= 'a' && first <= 'z' && findForbiddenChar(name) == '\0' &&
         !IsReservedAttribute(name);
}

namespace lockstep_detail {

LOCKSTEP_BTCPP_INLINE void check_port_name(StringView name) {
  if (IsAllowedPortName(name)) return;
  throw RuntimeError("'", name,
                     "' is not the name of a port: a letter first, no blanks, and none "
                     "of the characters <>&\"'/\\:*?|.");
}

}  // namespace lockstep_detail
}  // namespace BT
