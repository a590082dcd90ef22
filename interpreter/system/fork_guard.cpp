#include "system/fork_guard.h"

#include <sys/mman.h>

#include <cstddef>

namespace lockstep::host {

void ForkGuard::arm(void (*in_child)()) {
  constexpr std::size_t kSize = 4096;
  void* const memory =
      mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED || madvise(memory, kSize, MADV_WIPEONFORK) != 0) return;
  auto* const alive = static_cast<volatile unsigned char*>(memory);
  *alive = kAlive;
  in_child_ = in_child;
  alive_ = alive;
}

}  // namespace lockstep::host
