// Distinguishes a process from a child that it has forked. What owns threads, or other processes,
// keeps one: the child has its memory, but neither of them, and must leave them alone.
#pragma once

#include <cstdint>

namespace lockstep::host {

class OwnProcess {
 public:
  // Remembers the process of the caller.
  OwnProcess();
  // False in a child of it. No system call.
  bool is_this() const { return forks_ == s_forks; }

 private:
  static constinit inline std::uint32_t s_forks = 0;  // counted in each child
  std::uint32_t forks_;
};

}  // namespace lockstep::host
