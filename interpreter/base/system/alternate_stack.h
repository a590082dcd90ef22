// A separate stack for the signal handlers of one thread, because the thread's own stack may have
// overflowed. Used by own_thread.cpp.
#pragma once

#include <signal.h>
#include <sys/mman.h>

#include <cstddef>

namespace lockstep::host {

class AlternateStack {
 public:
  // For the thread that constructs it, which must also destroy it. If there is no memory, the
  // thread has no such stack.
  AlternateStack() {
    void* const memory = mmap(nullptr, kSize, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
    if (memory == MAP_FAILED) return;
    stack_t stack{};
    stack.ss_sp = memory;
    stack.ss_size = kSize;
    if (sigaltstack(&stack, &before_) == 0) {
      memory_ = memory;
    } else {
      munmap(memory, kSize);
    }
  }
  ~AlternateStack() {
    if (memory_ == nullptr) return;
    sigaltstack(&before_, nullptr);
    munmap(memory_, kSize);
  }
  AlternateStack(const AlternateStack&) = delete;
  AlternateStack& operator=(const AlternateStack&) = delete;

 private:
  // The kernel's part alone can be 12 KB.
  static constexpr std::size_t kSize = std::size_t{256} * 1024;
  void* memory_ = nullptr;
  stack_t before_{};
};

}  // namespace lockstep::host
