// The functions of port_value.h. Included by it.
#pragma once

#include "behaviortree_cpp/lockstep/port_value.h"

namespace BT::lockstep_detail {

LOCKSTEP_BTCPP_INLINE bool get_any_object(const Place& place, std::uint32_t port, Any& value) {
  for (const auto* known = first_known_object().load(); known != nullptr; known = known->next) {
    void* object = nullptr;
    if (!place.node->get_object(place.caller, port, known->type, &object)) continue;
    value = known->value(object);
    return true;
  }
  return false;
}

LOCKSTEP_BTCPP_INLINE bool get_any(const Place& place, std::uint32_t port, lockstep_type type,
                                   Any& value) {
  const auto read = [&](auto held) {
    if (!get(place, port, held)) return false;
    value = Any(held);
    return true;
  };
  switch (type) {
    case LOCKSTEP_BOOL:
      return read(false);
    case LOCKSTEP_INT:
      return read(std::int64_t{});
    case LOCKSTEP_DOUBLE:
      return read(double{});
#define LOCKSTEP_ROW(TYPE, of_type, Item) \
  case LOCKSTEP_##TYPE:                   \
    return read(ListOf<Item>());
      LOCKSTEP_LIST_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
    case LOCKSTEP_STRING_LIST:
      return read(std::vector<std::string>());
    case LOCKSTEP_OBJECT:
      return get_any_object(place, port, value);
    default:
      return false;
  }
}

LOCKSTEP_BTCPP_INLINE bool set_any(const Place& place, std::uint32_t port, const Any& any) {
  if (any.isType<bool>()) return set(place, port, any.cast<bool>());
  if (any.isString()) return set(place, port, any.cast<std::string>());
  if (any.isIntegral()) {
    const auto whole = any.tryCast<std::int64_t>();
    return whole && set(place, port, *whole);
  }
  if (any.isNumber()) return set(place, port, any.cast<double>());
  return any.lockstep_store_object(place, port);
}

}  // namespace BT::lockstep_detail
