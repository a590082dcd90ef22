#include "base/system/process_end.h"

#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "base/system/own_thread.h"
#include "base/system/pipe.h"

namespace lockstep::host {
namespace {

int open_pidfd(pid_t process) {
  return static_cast<int>(syscall(SYS_pidfd_open, process, 0));
}

void await_end(pid_t child, int bell) {
  siginfo_t info{};
  while (waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  eventfd_write(bell, 1);
}

}  // namespace

ProcessEnd::ProcessEnd(pid_t child) : descriptor_(open_pidfd(child)) {
  if (descriptor_.number() >= 0 || errno != ENOSYS) return;
  descriptor_ = FileDescriptor(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  const int bell = descriptor_.number();
  if (bell >= 0) waiting_ = own_thread([child, bell] { await_end(child, bell); });
}

void ProcessEnd::await() {
  if (waiting_.joinable()) waiting_.join();
}

// A pipe has an end when no process holds the other one any more: this one, and nobody else, keeps
// it until then.
FileDescriptor ProcessEnd::own() {
  FileDescriptor it(open_pidfd(getpid()));
  if (it.number() >= 0 || errno != ENOSYS) return it;
  static Pipe pipe;
  static const bool is_open = pipe.open();
  return FileDescriptor(is_open ? fcntl(pipe.reading.number(), F_DUPFD_CLOEXEC, 0) : -1);
}

}  // namespace lockstep::host
