// What the operating system can do for the thread that ticks: a real-time priority, memory that is
// never paged out, exact timers, a processor. Used by the command line, which tells the problems.
#pragma once

#include <optional>
#include <vector>

#include "core/problem.h"

namespace lockstep {

// Above what is usual for the threads of drivers (50), below the kernel's own (99).
constexpr int kRealtimePriority = 80;

struct RealtimeOptions {
  bool realtime = false;   // SCHED_FIFO at kRealtimePriority, mlockall, timer slack of 1 ns
  std::optional<int> cpu;  // the processor that the thread is bound to
};

// Applies to the calling thread; locked memory is the process's. The priority does not pass to
// threads and processes that the thread starts later, the processor does. Does all that is possible
// and returns what is not, with the privilege that is missing and who gives it, or what to choose
// instead.
[[nodiscard]] std::vector<Problem> apply_realtime(const RealtimeOptions& options);

}  // namespace lockstep
