// An object of a plugin (a leaf, control node or decorator), as the engine uses it. plugin/ creates
// and destroys it.
#pragma once

#include <cstdint>

struct lockstep_leaf_type;

namespace lockstep::host {

struct CallSite;

// A control node of a plugin may do this with its children at this moment.
enum class ChildAccess : std::uint8_t { None, Look, Tick };

// Read in every tick, so it is small.
struct LeafSlot {
  const lockstep_leaf_type* type = nullptr;
  void* self = nullptr;
  const CallSite* site = nullptr;         // names it when a call crashes or hangs
  const double* kept_progress = nullptr;  // where it keeps its progress; null: it is called
  const char* error = nullptr;  // set by the host's set_error: the reason, valid until taken
  // In one byte, of which one look is enough.
  bool failed : 1 = false;    // a tolerated fault in this activation, which ends in a Failure
  bool unreset : 1 = false;   // it begins from its last result, which its parent has not ended
  bool starts : 1 = true;     // its activation may begin with a call; false: one did without
  bool started = false;       // the activation began, so it has to be halted
  bool out_of_range = false;  // it has reported a progress outside [0, 1] in this run
  bool went_on = false;       // its progress has risen in this run while it was held
  ChildAccess access = ChildAccess::None;  // of a control node or decorator

  // A thread of the leaf may store it at this moment.
  double read_progress() const {
    double progress = 0;
    __atomic_load(kept_progress, &progress, __ATOMIC_RELAXED);
    return progress;
  }
};
static_assert(sizeof(LeafSlot) <= 48);

}  // namespace lockstep::host
