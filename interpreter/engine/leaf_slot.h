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
  const CallSite* site = nullptr;          // names it when a call crashes or hangs
  const double* kept_progress = nullptr;   // where it keeps its progress; null: it is called
  const char* error = nullptr;             // of the host's set_error: the reason, valid until taken
  std::uint8_t marks = kStarts | kRests;   // of those below; none: its tick is a call of `tick`
  bool out_of_range = false;               // it has reported a progress outside [0, 1] in this run
  bool went_on = false;                    // its progress has risen in this run while it was held
  ChildAccess access = ChildAccess::None;  // of a control node or decorator
  std::uint32_t reason_place = 0;  // in NodeContext::reasons(), and 1; 0: it has given none yet

  // kError: it has an error. kFailed: a tolerated fault in this activation, which ends in a
  // Failure. kUnreset: the activation begins from a result that its parent has not ended. kStarts:
  // it may begin with a call. kRests: it has nothing to halt. kHeld: it was, and may still be.
  // kTimed: its calls are timed also in a tick that times no others. kCut: it ran when its process
  // was cut, and this object has not begun yet (Ticker::go_on_after_cut).
  static constexpr std::uint8_t kFailed = 1, kUnreset = 2, kStarts = 4, kError = 8, kRests = 16,
                                kHeld = 32, kTimed = 64, kCut = 128;
  void mark(std::uint8_t with, bool is_so) {
    marks = static_cast<std::uint8_t>(is_so ? marks | with : marks & ~with);
  }
  void set_error(const char* reason) {
    error = reason;
    mark(kError, reason != nullptr);
  }
  // It has failed, or has an error, or is timed by itself, or was cut.
  bool is_unusual() const { return (marks & (kFailed | kError | kTimed | kCut)) != 0; }
  bool is_timed() const { return (marks & kTimed) != 0; }
  bool failed() const { return (marks & kFailed) != 0; }
  bool was_cut() const { return (marks & kCut) != 0; }
  // Nothing of it may be called in this activation, or not before its start.
  bool is_out() const { return (marks & (kFailed | kCut)) != 0; }
  bool unreset() const { return (marks & kUnreset) != 0; }
  // The activation began, so it has to be halted.
  bool started() const { return (marks & kRests) == 0; }
  void set_started(bool is_so) { mark(kRests, !is_so); }

  // A thread of the leaf may store it at this moment.
  double read_progress() const {
    double progress = 0;
    __atomic_load(kept_progress, &progress, __ATOMIC_RELAXED);
    return progress;
  }
};
static_assert(sizeof(LeafSlot) <= 48);

}  // namespace lockstep::host
