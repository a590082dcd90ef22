// Where a node is: the host that calls it, and how the host names it.
#pragma once

#include <lockstep/leaf.h>
#include <lockstep/cpp/caller.hpp>

#include <cstdint>
#include <string>

namespace BT::detail {

struct Registration;

struct Place {
  const lockstep_host* host = nullptr;
  const lockstep_caller* caller = nullptr;
  const lockstep_place* node = nullptr;
  const lockstep_children* children = nullptr;  // of a control node or decorator
  const Registration* registration = nullptr;   // of its type
  bool is_in_tick = false;
};

}  // namespace BT::detail
