#include "leaves/remote/json_lines/guardian.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "base/core/running_time.h"
#include "base/system/pipe.h"
#include "base/system/process_end.h"
#include "leaves/remote/json_lines/orphans.h"

namespace lockstep::host {
namespace {

using Given = GuardianDescriptors;

void report(GuardianReport::What what, int number, int status = 0) {
  const GuardianReport report{what, number, status};
  send(Given::kControl, &report, sizeof report, MSG_NOSIGNAL);
}

// In the child. The death of the guardian is its own, too.
[[noreturn]] void become_program(const std::string& path, pid_t guardian, int errors) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != guardian) _exit(127);
  char* arguments[] = {const_cast<char*>(path.c_str()), nullptr};  // NOLINT: as execv takes them
  execv(path.c_str(), arguments);
  const int error = errno;
  const ssize_t written = write(errors, &error, sizeof error);
  _exit(written == sizeof error ? 127 : 126);
}

}  // namespace

std::filesystem::path python_modules(const std::filesystem::path& leafhost_directory) {
  std::error_code error;
  auto modules = leafhost_directory / "python";  // in a build directory
  if (!std::filesystem::is_directory(modules, error)) {
    modules = leafhost_directory / LOCKSTEP_PYTHON_FROM_LEAFHOST;
  }
  return modules.lexically_normal();
}

namespace {

// So that a program in Python finds lockstep_leaf.py, behind all that its user has.
void help_python() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  const char* const given = std::getenv("PYTHONPATH");
  const std::string before = given == nullptr || *given == '\0' ? "" : std::string(given) + ":";
  setenv("PYTHONPATH", (before + python_modules(here).string()).c_str(), 1);
}

// The process, or nothing after a report why there is none.
std::optional<pid_t> start_program(const std::string& path) {
  Pipe errors;
  if (!errors.open()) {
    report(GuardianReport::What::NotStarted, errno);
    return std::nullopt;
  }
  const pid_t guardian = getpid();
  const pid_t pid = fork();
  if (pid == 0) become_program(path, guardian, errors.writing.number());
  int error = errno;
  if (pid > 0) {
    setpgid(pid, pid);
    errors.writing = FileDescriptor();
    const bool failed = read(errors.reading.number(), &error, sizeof error) == sizeof error;
    if (!failed) return pid;
    waitpid(pid, nullptr, 0);
  }
  report(GuardianReport::What::NotStarted, error);
  return std::nullopt;
}

// Processes that the program's children have started outlive them as children of ours.
void end_orphans() {
  do {
    for (const pid_t child : own_children()) kill(child, SIGKILL);
  } while (waitpid(-1, nullptr, 0) >= 0 || errno != ECHILD);
}

class Guard {
 public:
  explicit Guard(pid_t program) : program_(program), end_(program) {}

  // Returns when the host has let go of the program, or has died.
  void watch() {
    pollfd ends[3] = {
        {Given::kControl, POLLIN, 0}, {Given::kParent, POLLIN, 0}, {end_.descriptor(), POLLIN, 0}};
    while (true) {
      poll(ends, 3, patience());
      if (ends[1].revents != 0) return;
      if (ends[0].revents != 0 && !obey()) return;
      if (ends[2].fd >= 0 && ends[2].revents != 0) {
        tell_end();
        ends[2] = {-1, 0, 0};
      }
      if (clock_.wait_until(deadline_) == Nanoseconds(0)) {
        ::kill(-program_, SIGKILL);
        deadline_.reset();
      }
    }
  }

 private:
  int patience() {
    const auto left = clock_.wait_until(deadline_);
    return left ? static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(*left).count())
                : -1;
  }

  // False: the host has nothing more to say.
  bool obey() {
    GuardianOrder order{};
    const ssize_t size = recv(Given::kControl, &order, sizeof order, MSG_DONTWAIT);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return true;
    if (size != sizeof order) return false;
    kill(-program_, SIGTERM);
    kill(-program_, SIGCONT);
    if (order.nanoseconds >= 0) deadline_ = clock_.now() + Nanoseconds(order.nanoseconds);
    return true;
  }

  // The number of its group is kept from others by the process, which is not waited for.
  void tell_end() {
    siginfo_t info{};
    waitid(P_PID, static_cast<id_t>(program_), &info, WEXITED | WNOWAIT);
    ::kill(-program_, SIGKILL);
    report(GuardianReport::What::Ended, info.si_code, info.si_status);
  }

  pid_t program_;
  ProcessEnd end_;
  RunningClock clock_;
  std::optional<Nanoseconds> deadline_;
};

}  // namespace

bool is_guardian() {
  return fcntl(Given::kControl, F_GETFD) >= 0 && fcntl(Given::kParent, F_GETFD) >= 0 &&
         getpgrp() == getpid();
}

int guard_program(const std::string& path) {
  signal(SIGPIPE, SIG_DFL);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  help_python();
  mark_own_orphans();
  fcntl(Given::kControl, F_SETFD, FD_CLOEXEC);
  fcntl(Given::kParent, F_SETFD, FD_CLOEXEC);
  const auto program = start_program(path);
  if (!program) return 1;
  // The end of what the program writes, and reads, is to be seen by who reads, and writes.
  const FileDescriptor nothing(open("/dev/null", O_RDWR | O_CLOEXEC));
  dup2(nothing.number(), Given::kRequests);
  dup2(nothing.number(), Given::kAnswers);
  report(GuardianReport::What::Started, *program);
  Guard guard(*program);
  guard.watch();
  kill(-*program, SIGKILL);
  end_orphans();
  return 0;
}

}  // namespace lockstep::host
