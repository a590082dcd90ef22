// Preloaded into a program, takes its memory away: from the n-th `new` of main on, n of
// NO_MEMORY_AT, every one throws. Before main, where nobody could catch it, none does.
#include <dlfcn.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

using Main = int (*)(int, char**, char**);

std::atomic<long> g_left{1'000'000'000'000};
Main g_main = nullptr;

int main_without_memory(int count, char** arguments, char** environment) {
  if (const char* const text = std::getenv("NO_MEMORY_AT")) g_left = std::atol(text);
  return g_main(count, arguments, environment);
}

}  // namespace

// What glibc's start of a program calls, with its main.
extern "C" int __libc_start_main(  // NOLINT
    Main program, int count, char** arguments, void (*init)(), void (*fini)(),
    void (*loader_fini)(), void* stack_end) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  g_main = program;
  return start(main_without_memory, count, arguments, init, fini, loader_fini, stack_end);
}

// The sanitizers have one too, whose memory is not malloc's.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (g_left <= 1 || g_left.fetch_sub(1) <= 1) return nullptr;
  return std::malloc(size == 0 ? 1 : size);  // NOLINT: that is what it is for
}

void* operator new(std::size_t size) {
  void* const memory = operator new(size, std::nothrow);
  if (memory != nullptr) return memory;
  if (const auto handler = std::get_new_handler()) handler();
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
  std::free(memory);  // NOLINT
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);  // NOLINT
}
