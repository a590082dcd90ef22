#include "cli/tools/mcp/tool_process.h"

#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "base/core/clock.h"

namespace lockstep::host {
namespace {

using End = ToolOutcome::End;

constexpr Nanoseconds kBetweenNotes = std::chrono::seconds(1);

// A group of its own, so that what it starts ends with it.
int start(const std::vector<std::string>& words, const Pipe& in, const Pipe& out, const Pipe& err,
          pid_t& process) {
  std::string program = "/proc/self/exe", name = "lockstep";
  std::vector<std::string> copies(words);
  std::vector<char*> arguments{name.data()};
  for (std::string& it : copies) arguments.push_back(it.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in.reading.number(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out.writing.number(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, err.writing.number(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGXFSZ}) sigaddset(&signals, signal);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  const int failure =
      posix_spawn(&process, program.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return failure;
}

void limit(pid_t process, const ToolLimits& limits) {
  const rlimit memory{limits.memory, limits.memory};
  prlimit(process, RLIMIT_AS, &memory, nullptr);
  // Also where the server has gone.
  const auto seconds = static_cast<rlim_t>(to_seconds(limits.time)) * 64 + 1;
  const rlimit time{seconds, seconds};
  prlimit(process, RLIMIT_CPU, &time, nullptr);
  const rlimit no_core{0, 0};
  prlimit(process, RLIMIT_CORE, &no_core, nullptr);
}

std::string_view last_line(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  return text.substr(text.rfind('\n') + 1);
}

class Conversation {
 public:
  Conversation(Pipe& in, Pipe& out, Pipe& err, int cancel, const std::string& input,
               const ToolLimits& limits)
      : in_(in), out_(out), err_(err), cancel_(cancel), rest_(input), limits_(limits) {
    for (const int file : {in.writing.number(), out.reading.number(), err.reading.number()})
      fcntl(file, F_SETFL, O_NONBLOCK);
  }

  // Until all is read, or it has to end.
  End run(ToolOutcome& outcome,
          const std::function<void(double seconds, std::string_view line)>& progress) {
    const Nanoseconds began = monotonic_now();
    Nanoseconds noted = began;
    while (out_.reading.number() >= 0 || err_.reading.number() >= 0) {
      const Nanoseconds now = monotonic_now();
      if (now - began >= limits_.time) return End::Time;
      if (now - noted >= kBetweenNotes) {
        noted = now;
        progress(to_seconds(now - began), last_line(outcome.err));
      }
      const Nanoseconds wait = std::min(began + limits_.time, noted + kBetweenNotes) - now;
      pollfd files[] = {{cancel_, POLLIN, 0},
                        {out_.reading.number(), POLLIN, 0},
                        {err_.reading.number(), POLLIN, 0},
                        {in_.writing.number(), POLLOUT, 0}};
      const int ready = ::poll(files, 4, static_cast<int>(to_seconds(wait) * 1000) + 1);
      if (ready <= 0) continue;
      if (files[0].revents != 0) return End::Cancelled;
      if (files[1].revents != 0) read(out_.reading, outcome.out);
      if (files[2].revents != 0) read(err_.reading, outcome.err);
      if (files[3].revents != 0) write();
      if (std::max(outcome.out.size(), outcome.err.size()) > limits_.output) return End::Output;
    }
    return End::Exited;
  }

 private:
  static void read(FileDescriptor& from, std::string& to) {
    std::array<char, 1u << 16u> bytes;
    const auto count = ::read(from.number(), bytes.data(), bytes.size());
    if (count > 0) to.append(bytes.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) from = FileDescriptor();
  }

  void write() {
    const auto count =
        rest_.empty() ? 0 : ::write(in_.writing.number(), rest_.data(), rest_.size());
    if (count > 0) rest_.remove_prefix(static_cast<std::size_t>(count));
    const bool is_refused = count < 0 && errno != EINTR && errno != EAGAIN;
    if (rest_.empty() || is_refused) in_.writing = FileDescriptor();
  }

  Pipe &in_, &out_, &err_;
  const int cancel_;
  std::string_view rest_;  // of the input
  const ToolLimits& limits_;
};

}  // namespace

ToolProcess::ToolProcess() {
  cancel_.open();
}

void ToolProcess::cancel() {
  const char byte = 0;
  static_cast<void>(!::write(cancel_.writing.number(), &byte, 1));
}

ToolOutcome ToolProcess::run(
    const std::vector<std::string>& words, const std::string& input, const ToolLimits& limits,
    const std::function<void(double seconds, std::string_view line)>& progress) {
  ToolOutcome outcome;
  Pipe in, out, err;
  if (!in.open() || !out.open() || !err.open()) {
    outcome.code = errno;
    return outcome;
  }
  pid_t process = 0;
  outcome.code = start(words, in, out, err, process);
  if (outcome.code != 0) return outcome;
  limit(process, limits);
  in.reading = FileDescriptor();
  out.writing = FileDescriptor();
  err.writing = FileDescriptor();
  Conversation talk(in, out, err, cancel_.reading.number(), input, limits);
  outcome.end = talk.run(outcome, progress);
  if (outcome.end != End::Exited) kill(-process, SIGKILL);
  siginfo_t ended;
  while (waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOWAIT) < 0 &&
         errno == EINTR) {
  }
  kill(-process, SIGKILL);  // what it has left behind
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (outcome.end != End::Exited) return outcome;
  if (WIFSIGNALED(status)) outcome.end = End::Signal;
  outcome.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  return outcome;
}

}  // namespace lockstep::host
