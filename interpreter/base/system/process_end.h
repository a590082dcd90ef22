// The end of a process, as a descriptor that becomes readable with it.
#pragma once

#include <sys/types.h>

#include <thread>

#include "base/system/file_descriptor.h"

namespace lockstep::host {

// Of a child. Where the kernel has no such descriptor, or
// valgrind in front of it, a thread waits for the end.
class ProcessEnd {
 public:
  ProcessEnd() = default;
  explicit ProcessEnd(pid_t child);
  ~ProcessEnd() { await(); }
  ProcessEnd(ProcessEnd&&) = default;
  ProcessEnd& operator=(ProcessEnd&&) = default;

  // Waits for the end where a thread does: before the child is reaped, so that its number is its
  // own.
  void await();
  // -1, with errno: it cannot be watched.
  int descriptor() const { return descriptor_.number(); }

  // That of this process, for a child to have; -1, with errno: none.
  static FileDescriptor own();

 private:
  FileDescriptor descriptor_;
  std::thread waiting_;
};

}  // namespace lockstep::host
