// What the operating system gives and refuses, each in a child process, which keeps it to itself.
#include "run/realtime.h"

#include <linux/capability.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <functional>

namespace lockstep::host::test {
namespace {

// Their mlockall does nothing: the shadow memory would be locked too.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsLocked = false;
#else
constexpr bool kMemoryIsLocked = true;
#endif

// Of this process, "" when the kernel does not say.
std::string status_line(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == name && status >> word) return word;
  }
  return {};
}

// Root in a container may have neither of the two privileges.
bool may_be_realtime() {
  const std::string capabilities = status_line("CapEff:");
  const unsigned long long given = std::stoull("0" + capabilities, nullptr, 16);
  return (given >> CAP_SYS_NICE & 1) != 0 && (given >> CAP_IPC_LOCK & 1) != 0;
}

// What `say` returns in a child process; "" when that does not end well.
std::string said_in_child(const std::function<std::string()>& say) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    const std::string said = say();
    _exit(write(ends[1], said.data(), said.size()) == static_cast<ssize_t>(said.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string heard;
  char buffer[4096];
  for (ssize_t size = 0; (size = read(ends[0], buffer, sizeof buffer)) > 0;) {
    heard.append(buffer, static_cast<std::size_t>(size));
  }
  close(ends[0]);
  int status = -1;
  waitpid(child, &status, 0);
  return status == 0 ? heard : "";
}

std::string told(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += problem.message + "\n" + problem.hint + "\n";
  return text.empty() ? "no problem\n" : text;
}

// What root is given, an ordinary user without limits of its own is not.
void become_nobody() {
  const rlimit none{0, 0};
  const rlimit little{65536, 65536};
  setrlimit(RLIMIT_RTPRIO, &none);
  setrlimit(RLIMIT_MEMLOCK, &little);
  if (geteuid() == 0 && setresuid(65534, 65534, 65534) != 0) _exit(1);
}

std::string state() {
  sched_param parameters{};
  sched_getparam(0, &parameters);
  const int policy = sched_getscheduler(0);
  const bool exact = prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL) <= 1;
  return (policy == (SCHED_FIFO | SCHED_RESET_ON_FORK) ? "fifo " : "other ") +
         std::to_string(parameters.sched_priority) + (exact ? " exact" : " slack") +
         (status_line("VmLck:") != "0" ? " locked" : " pageable");
}

// The problems, and what has become of the thread.
std::string state_after(const RealtimeOptions& options) {
  const std::string problems = told(apply_realtime(options));
  return problems + state();
}

cpu_set_t allowed_cpus() {
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  sched_getaffinity(0, sizeof cpus, &cpus);
  return cpus;
}

int last_allowed_cpu() {
  const cpu_set_t cpus = allowed_cpus();
  int last = CPU_SETSIZE - 1;
  while (!CPU_ISSET(last, &cpus)) --last;
  return last;
}

std::optional<Processors> only(int cpu) {
  return Processors::parse(std::to_string(cpu));
}

}  // namespace

TEST_CASE("who may gets a real-time priority, locked memory and exact timers") {
  if (!may_be_realtime()) {
    WARN("without CAP_SYS_NICE and CAP_IPC_LOCK only the refusal is tested");
    return;
  }
  const std::string expected =
      std::string("no problem\nfifo 80 exact") + (kMemoryIsLocked ? " locked" : " pageable");
  CHECK(said_in_child([] { return state_after({.realtime = true}); }) == expected);
}

TEST_CASE("the priority can be chosen") {
  if (!may_be_realtime()) return;
  const std::string all =
      said_in_child([] { return state_after({.realtime = true, .priority = 42}); });
  CHECK_THAT(all, Catch::StartsWith("no problem\nfifo 42 "));
}

TEST_CASE("a child of a real-time thread is an ordinary one") {
  if (!may_be_realtime()) {
    WARN("without CAP_SYS_NICE no thread is real-time here");
    return;
  }
  CHECK(said_in_child([] {
          const auto problems = apply_realtime({.realtime = true});
          if (!problems.empty()) return problems[0].message;
          return said_in_child(
              [] { return std::to_string(sched_getscheduler(0) & ~SCHED_RESET_ON_FORK); });
        }) == std::to_string(SCHED_OTHER));
}

TEST_CASE("who may not get real time reads which privilege is missing and who gives it") {
  const std::string all = said_in_child([] {
    become_nobody();
    return state_after({.realtime = true});
  });
  CHECK_THAT(all, Catch::Contains("cannot take the real-time priority 80 (SCHED_FIFO)") &&
                      Catch::Contains("CAP_SYS_NICE") && Catch::Contains("RLIMIT_RTPRIO") &&
                      Catch::Contains("'ulimit -r' is 0") &&
                      Catch::Contains("/etc/security/limits.conf") &&
                      Catch::Contains("setcap cap_sys_nice,cap_ipc_lock+ep"));
  if (kMemoryIsLocked) {
    CHECK_THAT(all, Catch::Contains("cannot lock the memory (mlockall)") &&
                        Catch::Contains("CAP_IPC_LOCK") && Catch::Contains("RLIMIT_MEMLOCK") &&
                        Catch::Contains("'ulimit -l' is 64"));
  }
  CHECK_THAT(all, Catch::EndsWith("other 0 exact pageable"));  // exact timers need no privilege
}

TEST_CASE("a thread is bound to the cpu that was asked for, and to nothing else") {
  const int cpu = last_allowed_cpu();
  const std::string bound = said_in_child([cpu] {
    const std::string said = state_after({.processors = only(cpu)});
    const cpu_set_t now = allowed_cpus();
    return said + (CPU_COUNT(&now) == 1 && CPU_ISSET(cpu, &now) ? " bound" : " not bound");
  });
  CHECK(bound == "no problem\nother 0 slack pageable bound");
}

TEST_CASE("a cpu that is not there or not allowed is refused with those that are") {
  const int cpu = last_allowed_cpu();
  const std::string hint = "allowed is " + std::to_string(cpu) + "\n";
  const auto refusal = [cpu](int asked) {
    return said_in_child([cpu, asked] {
      const auto problems = apply_realtime({.processors = only(cpu)});
      if (!problems.empty()) return problems[0].message;
      return told(apply_realtime({.processors = only(asked)}));
    });
  };
  CHECK(refusal(1023) == "cpu 1023 does not exist\n" + hint);
  if (cpu > 0)
    CHECK(refusal(cpu - 1) ==
          "cpu " + std::to_string(cpu - 1) + " is not allowed for this process\n" + hint);
}

}  // namespace lockstep::host::test
