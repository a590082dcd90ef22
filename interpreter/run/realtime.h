// Operating system settings for the tick thread: a real-time priority, locked memory, exact timers,
// a processor. Used by the command line, which reports the problems.
#pragma once

#include <optional>
#include <vector>

#include "base/core/problem.h"
#include "base/system/processors.h"

namespace lockstep::host {

struct RealtimeOptions {
  bool realtime = false;  // SCHED_FIFO, mlockall, timer slack of 1 ns
  // In [1, 99]. Above what is usual for the threads of drivers (50), below the kernel's own (99).
  int priority = 80;
  std::optional<Processors> processors = {};  // that the thread is bound to
};

// Applies to the calling thread; locked memory is the process's. The priority does not pass to
// threads and processes that the thread starts later, the processor does. Applies what is possible
// and returns a problem for the rest, with the missing privilege and how to get it, or with the
// alternatives.
[[nodiscard]] std::vector<Problem> apply_realtime(const RealtimeOptions& options);

}  // namespace lockstep::host
