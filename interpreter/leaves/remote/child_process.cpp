#include "leaves/remote/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace lockstep::host {
namespace {

// The steps that posix_spawn does in the child before the program begins.
class SpawnPlan {
 public:
  SpawnPlan() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  // The output of a leaf must not mix with our data; nothing else is inherited.
  void set_descriptors(std::span<const ChildProcess::Given> given) {
    const bool has_errors = fcntl(STDERR_FILENO, F_GETFD) >= 0;
    posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    if (!has_errors) posix_spawn_file_actions_addopen(&actions_, 2, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, 2, 1);
    int last = 2;
    for (const auto& [ours, theirs] : given) {
      posix_spawn_file_actions_adddup2(&actions_, ours, theirs);
      last = std::max(last, theirs);
    }
    posix_spawn_file_actions_addclosefrom_np(&actions_, last + 1);
  }

  // Ctrl-C of a terminal is for the host, which then halts the leaves in order: hence a separate
  // group.
  void set_attributes() {
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }

  int spawn(pid_t& pid, const std::string& program, std::vector<std::string> arguments) const {
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    return posix_spawn(&pid, program.c_str(), &actions_, &attributes_, pointers.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

// A copy above the numbers that the child gives them, so that none overwrites the other.
int high_copy(int descriptor) {
  return fcntl(descriptor, F_DUPFD_CLOEXEC, 10);
}

}  // namespace

std::string error_text(int error) {
  return std::strerror(error);  // NOLINT(concurrency-mt-unsafe): known errors, constant texts
}

std::string describe_end(int code, int status) {
  if (code == CLD_EXITED) return fmt::format("ended with exit code {}", status);
  const char* const name = sigabbrev_np(status);
  const char* const text = sigdescr_np(status);
  if (name == nullptr) return fmt::format("was killed by signal {}", status);
  return fmt::format("was killed by SIG{} ({})", name, text == nullptr ? "" : text);
}

std::string ChildProcess::start(const std::string& program, std::vector<std::string> arguments,
                                std::span<const Given> given) {
  std::vector<FileDescriptor> copies;
  std::vector<Given> high;
  for (const auto& [ours, theirs] : given) {
    copies.emplace_back(high_copy(ours));
    if (copies.back().number() < 0) return error_text(errno);
    high.push_back({copies.back().number(), theirs});
  }
  SpawnPlan plan;
  plan.set_descriptors(high);
  plan.set_attributes();
  pid_t pid = -1;
  if (const int error = plan.spawn(pid, program, std::move(arguments)); error != 0) {
    return error_text(error);
  }
  {
    const Lock lock(mutex_);
    pid_ = pid;
  }
  end_ = ProcessEnd(pid);
  if (end_.descriptor() >= 0) return {};
  const std::string reason = error_text(errno);
  kill();
  reap();
  return fmt::format("it cannot be watched: {}", reason);
}

pid_t ChildProcess::number() const {
  const Lock lock(mutex_);
  return pid_;
}

ChildProcess::~ChildProcess() {
  if (number() > 0) {
    kill();
    reap();
  }
}

void ChildProcess::kill() {
  const Lock lock(mutex_);
  if (pid_ <= 0) return;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);  // which may have left its group
}

std::string ChildProcess::reap() {
  const pid_t pid = number();
  siginfo_t info{};
  // First without taking its number away: as long as it is a zombie, the number of its group cannot
  // be somebody else's.
  while (waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  end_.await();
  const Lock lock(mutex_);
  ::kill(-pid_, SIGKILL);
  while (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED) != 0 && errno == EINTR) {
  }
  pid_ = -1;
  return describe_end(info.si_code, info.si_status);
}

}  // namespace lockstep::host
