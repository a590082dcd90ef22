// A child process in a separate process group: started with two descriptors, killed with its group,
// reaped once. It notices the death of its parent. Knows nothing about plugins.
#pragma once

#include <sys/types.h>

#include <mutex>
#include <string>

#include "core/file_descriptor.h"

namespace lockstep {

class ChildProcess {
 public:
  // What the program finds under these numbers, beside 0 (empty), 1 and 2 (our standard error).
  static constexpr int kMemory = 3;
  static constexpr int kBell = 4;
  static constexpr int kParent = 5;  // a pidfd of ours: readable when we have ended

  // Runs `program argument`. Returns "" or the reason of a failure. The caller keeps the
  // descriptors.
  std::string start(const std::string& program, const std::string& argument, int memory, int bell);

  ChildProcess() = default;
  // Kills and reaps it, unless that was already done.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Becomes readable when the process has ended.
  int descriptor() const { return descriptor_.number(); }
  // Sends SIGKILL to it, even if it has left its group, and to that group, unless it has been
  // reaped. May be called from any thread.
  void kill();
  // Waits for its end, kills the rest of its group, and returns how it ended: "was killed by
  // SIGSEGV (Segmentation fault)", "ended with exit code 3".
  std::string reap();

 private:
  std::mutex mutex_;
  pid_t pid_ = -1;  // -1: none, or reaped
  FileDescriptor descriptor_;
};

}  // namespace lockstep
