// How plugins live in other processes, and how long lockstep waits for them.
#pragma once

#include <optional>
#include <string>

#include "base/core/clock.h"

namespace lockstep::host {

struct IsolationOptions {
  std::string leafhost;                               // path of the program lockstep-leafhost
  Nanoseconds hang_limit = std::chrono::seconds(10);  // 0 = never
  // Programs: how long they may take to answer a halt, and to end when they are asked to.
  std::optional<Nanoseconds> halt_limit = std::chrono::seconds(1);
  // Conditions of programs, on the wall clock: how long a tick waits for their answers, and how old
  // a result may be. Nothing: a fifth of the period, 2 ms at most, and five periods.
  std::optional<Nanoseconds> condition_wait = {}, condition_age = {};
  bool all = false;           // whatever is passed to a load function
  bool run_programs = false;  // else what they have is read from a file beside them
  // Nobody runs leaves: all are in other processes, also those that could not do their work there.
  bool only_described = false;
};

}  // namespace lockstep::host
