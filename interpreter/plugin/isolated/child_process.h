// A child process in a process group of its own: started with two descriptors, killed with its
// group, reaped once. It can see the death of its parent. Knows nothing of plugins.
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

  // Runs `program argument`. "" or why not. The descriptors stay the caller's.
  std::string start(const std::string& program, const std::string& argument, int memory, int bell);

  ChildProcess() = default;
  // Kills and reaps it, unless that is done.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Becomes readable when the process has ended.
  int descriptor() const { return descriptor_.number(); }
  // SIGKILL to it, wherever it has gone, and to the group that it was given, unless it has been
  // reaped. From any thread.
  void kill();
  // Waits for its end, kills what is left of its group, and says how it ended: "was killed by
  // SIGSEGV (Segmentation fault)", "ended with exit code 3".
  std::string reap();

 private:
  std::mutex mutex_;
  pid_t pid_ = -1;  // -1: none, or reaped
  FileDescriptor descriptor_;
};

}  // namespace lockstep
