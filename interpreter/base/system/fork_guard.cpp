#include "base/system/fork_guard.h"

#include <sys/mman.h>

#include <array>
#include <cstddef>
#include <mutex>

namespace lockstep::host {
namespace {

constexpr std::size_t kSize = 4096;
std::mutex g_bytes_lock;
std::uint8_t* g_bytes = nullptr;  // kSize, the first of which is that of check()
std::size_t g_used = 0;           // so many of them have been taken
// Of these, what was given back. Not all at once in the beginning: that touches eight pages.
std::array<std::uint8_t*, kSize> g_free_bytes;
std::size_t g_free = 0;

}  // namespace

void ForkGuard::arm(void (*in_child)()) {
  void* const memory =
      mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED || madvise(memory, kSize, MADV_WIPEONFORK) != 0) return;
  auto* const bytes = static_cast<std::uint8_t*>(memory);
  const std::scoped_lock lock(g_bytes_lock);
  g_bytes = bytes;
  g_used = 1;
  g_free = 0;
  *bytes = kAlive;
  in_child_ = in_child;
  alive_ = bytes;
}

ForkGuard::Byte::Byte() : byte_(&own_) {
  if (alive_ == &kAlive) return;
  const std::scoped_lock lock(g_bytes_lock);
  if (g_free > 0) {
    byte_ = g_free_bytes[--g_free];
  } else if (g_used < kSize) {
    byte_ = g_bytes + g_used++;
  } else {
    return;
  }
  set();
}

ForkGuard::Byte::~Byte() {
  if (byte_ == &own_) return;
  const std::scoped_lock lock(g_bytes_lock);
  g_free_bytes[g_free++] = byte_;
}

}  // namespace lockstep::host
