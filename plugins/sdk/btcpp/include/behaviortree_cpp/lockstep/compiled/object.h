// The functions of object.h. Included by it.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "behaviortree_cpp/lockstep/object.h"

namespace BT::lockstep_detail {

LOCKSTEP_BTCPP_INLINE std::string object_name(std::type_index type) {
  std::string name = readable(type);
  bool is_plain = name.size() <= 100;
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (char& c : name) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (is_letter || (c >= '0' && c <= '9') ||
        std::string_view("._:/- <>,*&()[]").find(c) != std::string::npos) {
      continue;
    }
    is_plain = false;
    c = '-';
  }
  if (is_plain) return name;
  char number[20];
  std::snprintf(number, sizeof number, ".%016llx", static_cast<unsigned long long>(hash));
  return name.substr(0, 80) + number;
}

LOCKSTEP_BTCPP_INLINE void know_object(KnownObject& it) {
  it.next = first_known_object().load();
  while (!first_known_object().compare_exchange_weak(it.next, &it)) {
  }
}

}  // namespace BT::lockstep_detail
