// The tables of plugins that tests are made of: whoever makes one names what it has, and all else
// is absent. Seen by plugins too, so it knows nothing of the interpreter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lockstep/leaf.h"

namespace lockstep::tables {

constexpr lockstep_port port(lockstep_type type, lockstep_direction direction, const char* name,
                             const char* default_value = nullptr) {
  lockstep_port port{};
  port.struct_size = sizeof port;
  port.type = type;
  port.direction = direction;
  port.name = name;
  port.default_value = default_value;
  return port;
}

// An action with the functions that each leaf needs.
constexpr lockstep_leaf_type leaf_type(const char* id, decltype(lockstep_leaf_type::create) create,
                                       decltype(lockstep_leaf_type::destroy) destroy,
                                       decltype(lockstep_leaf_type::tick) tick) {
  lockstep_leaf_type type{};
  type.struct_size = sizeof type;
  type.kind = LOCKSTEP_ACTION;
  type.id = id;
  type.create = create;
  type.destroy = destroy;
  type.tick = tick;
  return type;
}

// The list that a table of leaves or ports points to.
template <class Row, std::size_t kSize>
constexpr std::array<const Row*, kSize> list_of(const Row (&rows)[kSize]) {
  std::array<const Row*, kSize> list{};
  for (std::size_t i = 0; i < kSize; ++i) list[i] = &rows[i];
  return list;
}

template <std::size_t kSize>
constexpr void set_ports(lockstep_leaf_type& type,
                         const std::array<const lockstep_port*, kSize>& ports) {
  type.ports = ports.data();
  type.port_count = static_cast<std::uint32_t>(kSize);
}

template <std::size_t kSize>
constexpr lockstep_plugin plugin(const char* name,
                                 const std::array<const lockstep_leaf_type*, kSize>& leaves) {
  lockstep_plugin plugin{};
  plugin.abi_major = LOCKSTEP_ABI_MAJOR;
  plugin.abi_minor = LOCKSTEP_ABI_MINOR;
  plugin.struct_size = sizeof plugin;
  plugin.name = name;
  plugin.leaf_types = leaves.data();
  plugin.leaf_type_count = static_cast<std::uint32_t>(kSize);
  return plugin;
}

}  // namespace lockstep::tables
