// What leaves do that they must not: as the engine notes it, for those who tell it.
#pragma once

#include <string>

#include "trace/node_state.h"

namespace lockstep::host {

// A leaf failed as a program. The run ends: no leaf is started or ticked after it.
struct Fault {
  NodeIndex node = 0;
  std::string message;        // "threw …", "returned status 7, …"
  bool in_last_halt = false;  // it could not be halted at the end of the run

  friend bool operator==(const Fault&, const Fault&) = default;
};

// A leaf has reported a progress outside [0, 1], which was clamped.
struct OutOfRange {
  NodeIndex node = 0;
  double reported = 0;

  friend bool operator==(const OutOfRange&, const OutOfRange&) = default;
};

// A leaf has gone on while it was held.
struct WentOn {
  NodeIndex node = 0;
  double from = 0, to = 0;  // its progress when it was held, and when that was found
};

}  // namespace lockstep::host
