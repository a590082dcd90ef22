#include "base/system/fork_guard.h"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <deque>

using namespace lockstep::host;

namespace {

// What `action` returns, in a forked child.
int in_child(const auto& action) {
  const pid_t child = fork();
  if (child == 0) _exit(action());
  int status = 0;
  waitpid(child, &status, 0);
  return WEXITSTATUS(status);
}

}  // namespace

// In a child, since this process stays as it is for other tests.
TEST_CASE("4095 bytes of the fork guard at once are set and are cleared in a forked child") {
  const int failed_step = in_child([] {
    const ForkGuard::Byte early;
    if (!early.is_set() || !early.is_guarded()) return 1;  // nobody looks for children
    ForkGuard::arm([] {});
    if (early.is_guarded()) return 2;
    std::deque<ForkGuard::Byte> bytes(4095);
    for (ForkGuard::Byte& byte : bytes) {
      if (!byte.is_set() || !byte.is_guarded()) return 3;
    }
    if (in_child([&] { return bytes.front().is_set() || bytes.back().is_set() ? 1 : 0; }) != 0)
      return 4;
    if (ForkGuard::Byte().is_guarded()) return 5;
    bytes.front().clear();
    if (bytes.front().is_set() || !bytes.back().is_set()) return 6;
    bytes.clear();
    const ForkGuard::Byte again;
    return again.is_set() && again.is_guarded() ? 0 : 7;
  });
  CHECK(failed_step == 0);
}
