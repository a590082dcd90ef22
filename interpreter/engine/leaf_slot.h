// A leaf object of a plugin, as the engine uses it. plugin/ creates and destroys it.
#pragma once

struct lockstep_leaf_type;

namespace lockstep {

struct LeafSlot {
  const lockstep_leaf_type* type = nullptr;
  void* self = nullptr;
  bool started = false;         // the activation began, so it has to be halted
  bool failed = false;          // a tolerated fault in this activation, which ends in a Failure
  bool out_of_range = false;    // it has reported a progress outside [0, 1] in this run
  const char* error = nullptr;  // set by the host's set_error: the reason, valid until taken
};

}  // namespace lockstep
