#include "runtime/realtime.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lockstep {
namespace {

using Problems = std::vector<Problem>;

constexpr std::string_view kSetcap = "'setcap cap_sys_nice,cap_ipc_lock+ep' on the program";

std::string limit_text(decltype(RLIMIT_RTPRIO) resource, rlim_t unit) {
  rlimit limit{};
  getrlimit(resource, &limit);
  return limit.rlim_cur == RLIM_INFINITY ? "unlimited" : std::to_string(limit.rlim_cur / unit);
}

void raise_priority(Problems& problems) {
  sched_param parameters{};
  parameters.sched_priority = kRealtimePriority;
  if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0) return;
  problems.push_back(
      {fmt::format("cannot take the real-time priority {} (SCHED_FIFO): {}", kRealtimePriority,
                   std::strerror(errno)),
       fmt::format("it needs CAP_SYS_NICE ({}) or an RLIMIT_RTPRIO of at least {} ('ulimit -r' is "
                   "{}; set 'rtprio' in /etc/security/limits.conf and log in again)",
                   kSetcap, kRealtimePriority, limit_text(RLIMIT_RTPRIO, 1))});
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

// "0-3,6"
std::string list_of(const cpu_set_t& cpus) {
  std::string list;
  for (int first = 0; first < CPU_SETSIZE; ++first) {
    if (!CPU_ISSET(first, &cpus)) continue;
    int last = first;
    while (last + 1 < CPU_SETSIZE && CPU_ISSET(last + 1, &cpus)) ++last;
    if (!list.empty()) list += ',';
    list += first == last ? std::to_string(first) : fmt::format("{}-{}", first, last);
    first = last;
  }
  return list;
}

void bind_to(int cpu, Problems& problems) {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof allowed, &allowed);
  if (cpu < 0 || cpu >= CPU_SETSIZE || !CPU_ISSET(cpu, &allowed)) {
    const bool exists = cpu >= 0 && cpu < sysconf(_SC_NPROCESSORS_CONF);
    problems.push_back({fmt::format("cpu {} {}", cpu,
                                    exists ? "is not allowed for this process" : "does not exist"),
                        "allowed is " + list_of(allowed)});
    return;
  }
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(cpu, &one);
  if (sched_setaffinity(0, sizeof one, &one) == 0) return;
  problems.push_back(
      {fmt::format("cannot bind the tick thread to cpu {}: {}", cpu, std::strerror(errno)),
       "allowed is " + list_of(allowed)});
}

}  // namespace

std::vector<Problem> apply_realtime(const RealtimeOptions& options) {
  Problems problems;
  if (options.cpu) bind_to(*options.cpu, problems);
  if (!options.realtime) return problems;
  // First: a real-time thread has no slack, and later kernels do not let it set one.
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  raise_priority(problems);
  lock_memory(problems);
  return problems;
}

}  // namespace lockstep
