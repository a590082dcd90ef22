// Keeps stdout for results: while it lives, what plugins print goes to stderr instead.
#pragma once

#include <functional>

namespace lockstep {

class StdoutGuard {
 public:
  StdoutGuard();
  ~StdoutGuard();
  StdoutGuard(const StdoutGuard&) = delete;
  StdoutGuard& operator=(const StdoutGuard&) = delete;

  // Calls `print` with stdout as it was before.
  void print_results(const std::function<void()>& print);

 private:
  int results_ = -1;  // the real stdout; -1: it was closed
};

}  // namespace lockstep
