// Preloaded into a program, takes its memory away: from the n-th `new` on, n of NO_MEMORY_AT, every
// one throws.
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> g_left{-1};  // -1: not asked yet

long limit() {
  const char* const text = std::getenv("NO_MEMORY_AT");
  return text == nullptr ? 1'000'000'000 : std::atol(text);
}

}  // namespace

void* operator new(std::size_t size) {
  long none = -1;
  if (g_left == -1) g_left.compare_exchange_strong(none, limit());
  if (g_left <= 1 || g_left.fetch_sub(1) <= 1) throw std::bad_alloc();
  void* const memory = std::malloc(size == 0 ? 1 : size);  // NOLINT: that is what it is for
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept {
  std::free(memory);  // NOLINT
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);  // NOLINT
}
