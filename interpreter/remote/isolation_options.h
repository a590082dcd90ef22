// How plugins live in other processes, and how long lockstep waits for them.
#pragma once

#include <optional>
#include <string>

#include "core/clock.h"

namespace lockstep::host {

struct IsolationOptions {
  std::string leafhost;                               // path of the program lockstep-leafhost
  Nanoseconds hang_limit = std::chrono::seconds(10);  // 0 = never
  // Programs: how long they may take to answer a halt, and to end when they are asked to.
  std::optional<Nanoseconds> halt_limit = std::chrono::seconds(1);
  bool all = false;           // whatever is passed to a load function
  bool run_programs = false;  // else what they have is read from a file beside them
  // Nobody runs leaves: all are in other processes, also those that could not do their work there.
  bool only_described = false;
};

}  // namespace lockstep::host
