// An object of a plugin (a leaf, control node or decorator), as the engine uses it. plugin/ creates
// and destroys it.
#pragma once

#include <cstdint>
#include <span>

struct lockstep_leaf_type;

namespace lockstep {

class Ticker;

// What a control node of a plugin may do with its children at this moment.
enum class ChildAccess : std::uint8_t { None, Look, Tick };

struct LeafSlot {
  const lockstep_leaf_type* type = nullptr;
  void* self = nullptr;
  bool started = false;         // the activation began, so it has to be halted
  bool failed = false;          // a tolerated fault in this activation, which ends in a Failure
  bool out_of_range = false;    // it has reported a progress outside [0, 1] in this run
  const char* error = nullptr;  // set by the host's set_error: the reason, valid until taken
  // Of a control node or decorator.
  ChildAccess access = ChildAccess::None;
  Ticker* ticker = nullptr;  // while `access` is not None
  std::uint32_t node = 0;
  std::span<const std::uint32_t> children = {};  // their nodes, in order
};

}  // namespace lockstep
