// A child process in a separate process group: started with a few descriptors, killed with its
// group, reaped once. Knows nothing about plugins.
#pragma once

#include <sys/types.h>

#include <span>
#include <string>
#include <vector>

#include "base/system/mutex.h"
#include "base/system/process_end.h"

namespace lockstep::host {

// "was killed by SIGSEGV (Segmentation fault)", "ended with exit code 3"; `code` and `status` as
// waitid has them.
std::string describe_end(int code, int status);

// The system's text for an errno.
std::string error_text(int error);

class ChildProcess {
 public:
  // A descriptor of ours, and the number under which the program finds it.
  struct Given {
    int ours, theirs;
  };
  // Runs `program` with `arguments`, the first of which is its name. Beside what it is given it
  // finds 0 (empty), 1 and 2 (our standard error). Returns "" or the reason of a failure. The
  // caller keeps the descriptors.
  std::string start(const std::string& program, std::vector<std::string> arguments,
                    std::span<const Given> given);

  ChildProcess() = default;
  // Kills and reaps it, unless that was already done.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t number() const;  // -1: none, or reaped
  // Becomes readable when the process has ended.
  int descriptor() const { return end_.descriptor(); }
  // Sends SIGKILL to it, even if it has left its group, and to that group, unless it has been
  // reaped. May be called from any thread.
  void kill();
  // Waits for its end, kills the rest of its group, and returns how it ended.
  std::string reap();

 private:
  mutable Mutex mutex_;
  pid_t pid_ LOCKSTEP_GUARDED_BY(mutex_) = -1;  // -1: none, or reaped
  ProcessEnd end_;
};

}  // namespace lockstep::host
