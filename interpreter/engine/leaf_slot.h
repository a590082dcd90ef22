// An object of a plugin (a leaf, control node or decorator), as the engine uses it. plugin/ creates
// and destroys it.
#pragma once

#include <cstdint>

struct lockstep_leaf_type;

namespace lockstep::host {

// What a control node of a plugin may do with its children at this moment.
enum class ChildAccess : std::uint8_t { None, Look, Tick };

// Read in every tick, so it is small: two of them are in one line of the cache.
struct LeafSlot {
  const lockstep_leaf_type* type = nullptr;
  void* self = nullptr;
  const char* error = nullptr;  // set by the host's set_error: the reason, valid until taken
  bool started = false;         // the activation began, so it has to be halted
  bool failed = false;          // a tolerated fault in this activation, which ends in a Failure
  bool unreset = false;         // it begins from its last result, which its parent has not ended
  bool out_of_range = false;    // it has reported a progress outside [0, 1] in this run
  bool went_on = false;         // its progress has risen in this run while it was held
  ChildAccess access = ChildAccess::None;  // of a control node or decorator
};
static_assert(sizeof(LeafSlot) <= 32);

}  // namespace lockstep::host
