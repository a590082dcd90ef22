#include "cli/stdout_guard.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace lockstep {
namespace {

// What the C library holds back belongs to where stdout has pointed so far.
void point_stdout_to(int file) {
  std::fflush(stdout);
  dup2(file, STDOUT_FILENO);
}

}  // namespace

StdoutGuard::StdoutGuard() : results_(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3)) {
  if (results_ >= 0) point_stdout_to(STDERR_FILENO);
}

StdoutGuard::~StdoutGuard() {
  if (results_ < 0) return;
  point_stdout_to(results_);
  close(results_);
}

void StdoutGuard::print_results(const std::function<void()>& print) {
  if (results_ >= 0) point_stdout_to(results_);
  print();
  if (results_ >= 0) point_stdout_to(STDERR_FILENO);
}

}  // namespace lockstep
