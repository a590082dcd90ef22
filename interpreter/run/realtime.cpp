#include "run/realtime.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstring>

namespace lockstep::host {
namespace {

using Problems = std::vector<Problem>;

constexpr std::string_view kSetcap = "'setcap cap_sys_nice,cap_ipc_lock+ep' on the program";

std::string limit_text(decltype(RLIMIT_RTPRIO) resource, rlim_t unit) {
  rlimit limit{};
  getrlimit(resource, &limit);
  return limit.rlim_cur == RLIM_INFINITY ? "unlimited" : std::to_string(limit.rlim_cur / unit);
}

void raise_priority(int priority, Problems& problems) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0) return;
  problems.push_back(
      {fmt::format("cannot take the real-time priority {} (SCHED_FIFO): {}", priority,
                   std::strerror(errno)),
       fmt::format("it needs CAP_SYS_NICE ({}) or an RLIMIT_RTPRIO of at least {} ('ulimit -r' is "
                   "{}; set 'rtprio' in /etc/security/limits.conf and log in again)",
                   kSetcap, priority, limit_text(RLIMIT_RTPRIO, 1))});
}

void lock_memory(Problems& problems) {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return;
  problems.push_back(
      {fmt::format("cannot lock the memory (mlockall): {}", std::strerror(errno)),
       fmt::format("it needs CAP_IPC_LOCK ({}) or a larger RLIMIT_MEMLOCK ('ulimit -l' is {}, in "
                   "KiB; set 'memlock' to 'unlimited' in /etc/security/limits.conf and log in "
                   "again)",
                   kSetcap, limit_text(RLIMIT_MEMLOCK, 1024))});
}

}  // namespace

std::vector<Problem> apply_realtime(const RealtimeOptions& options) {
  Problems problems;
  if (options.processors) {
    if (auto problem = options.processors->bind_this_thread()) problems.push_back(*problem);
  }
  if (!options.realtime) return problems;
  // First: a real-time thread has no slack, and later kernels do not let it set one.
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  raise_priority(options.priority, problems);
  lock_memory(problems);
  return problems;
}

}  // namespace lockstep::host
