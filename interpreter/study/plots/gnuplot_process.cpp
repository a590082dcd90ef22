#include "study/plots/gnuplot_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <string_view>

#include "base/system/pipe.h"
#include "run/stop_signals.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMostSaid = 16384;  // bytes; a reader needs only the first error
constexpr int kLookInterval = 100;        // ms between looks for a stop signal

// The data of the child, made before it exists, since it may not allocate.
struct Plan {
  std::string program, directory, script;
  char* const* environment = environ;
};

// Null in a program with more rights than its user: who chooses PATH would choose what runs.
const char* search_path() {
  return secure_getenv("PATH");
}

// "" when there is none. What is relative would mean another place in the script's directory.
std::string find_gnuplot() {
  const char* const path = search_path();
  if (path == nullptr) return "/usr/bin/gnuplot";
  for (std::string_view left = path; !left.empty();) {
    const auto end = std::min(left.find(':'), left.size());
    const std::string program = std::string(left.substr(0, end)) + "/gnuplot";
    if (program.front() == '/' && access(program.c_str(), X_OK) == 0) return program;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return {};
}

char* const* environment() {
  static char path[] = "PATH=/usr/bin:/bin", locale[] = "LC_ALL=C.UTF-8";
  static char* const clean[] = {path, locale, nullptr};
  return search_path() == nullptr ? clean : environ;
}

void set_limit(__rlimit_resource resource, rlim_t most) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, most);
  setrlimit(resource, &limit);
}

// In the child. Returns only when gnuplot cannot be started: why.
int become_gnuplot(const Plan& plan, pid_t parent, int out) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it has ended in between
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  signal(SIGPIPE, SIG_DFL);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, 120);              // seconds
  set_limit(RLIMIT_AS, rlim_t{4} << 30u);  // an image of 16000 x 16000 pixels takes 1 GiB
  set_limit(RLIMIT_FSIZE, rlim_t{1} << 30u);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing < 0 || dup2(nothing, 0) < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0) return errno;
  if (chdir(plan.directory.c_str()) != 0) return errno;
  syscall(SYS_close_range, 3u, ~0u, 4u);       // CLOSE_RANGE_CLOEXEC: none is inherited
  char name[] = "gnuplot", defaults[] = "-d";  // -d: not what the user's ~/.gnuplot says
  char* const arguments[] = {name, defaults, const_cast<char*>(plan.script.c_str()), nullptr};
  execve(plan.program.c_str(), arguments, plan.environment);
  return errno;
}

// Reads what it says until it has closed its end, or a stop signal comes: then it is killed.
void listen(int file, pid_t pid, GnuplotEnd& ended) {
  std::array<char, 4096> buffer;
  for (;;) {
    if (!ended.stopped && StopSignals::received() != 0) {
      ended.stopped = true;
      kill(pid, SIGKILL);
    }
    pollfd wait{file, POLLIN, 0};
    if (poll(&wait, 1, kLookInterval) <= 0) continue;
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return;
    if (count < 0 || ended.said.size() >= kMostSaid) continue;
    ended.said.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

GnuplotEnd run_gnuplot(const std::filesystem::path& directory, const std::string& script) {
  const Plan plan{find_gnuplot(), directory.string(), "./" + script, environment()};
  if (plan.program.empty()) return {.reason = ENOENT};
  Pipe words, failure;
  if (!words.open() || !failure.open()) return {.reason = errno};
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) return {.reason = errno};
  if (pid == 0) {
    const int reason = become_gnuplot(plan, parent, words.writing.number());
    const ssize_t told = write(failure.writing.number(), &reason, sizeof reason);
    _exit(told == sizeof reason ? 127 : 126);
  }
  words.writing = FileDescriptor();
  failure.writing = FileDescriptor();
  GnuplotEnd ended;
  ssize_t count = 0;
  do count = read(failure.reading.number(), &ended.reason, sizeof ended.reason);
  while (count < 0 && errno == EINTR);
  if (ended.reason == 0) listen(words.reading.number(), pid, ended);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  ended.ok = ended.reason == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return ended;
}

}  // namespace lockstep::host
