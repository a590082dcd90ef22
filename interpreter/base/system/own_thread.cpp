#include "base/system/own_thread.h"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <climits>
#include <cstddef>
#include <exception>
#include <new>
#include <utility>

#include "base/system/alternate_stack.h"
#include "base/system/mutex.h"
#include "base/system/signal_mask.h"

namespace lockstep::host {
namespace {

constinit thread_local bool t_is_own = false;

std::optional<Processors> g_processors;

std::atomic<bool> g_has_failed{false};
Mutex g_failure_mutex;
std::exception_ptr g_failure LOCKSTEP_GUARDED_BY(g_failure_mutex);  // the first

// The stack of a thread that ends. Its thread_local objects go first, then, in rounds, what has a
// key; both may be a plugin's. This goes in the round before the last: in the last one, the runtime
// of AddressSanitizer unmaps the stack that the thread has then.
struct EndingStack {
  AlternateStack stack;
  int rounds = 0;
};
void end_round(void* stack);

pthread_key_t ending_key() {
  static const pthread_key_t key = [] {
    pthread_key_t made{};
    pthread_key_create(&made, end_round);
    return made;
  }();
  return key;
}

void end_round(void* stack) {
  auto* const it = static_cast<EndingStack*>(stack);
  if (++it->rounds < PTHREAD_DESTRUCTOR_ITERATIONS - 1) {
    pthread_setspecific(ending_key(), it);
  } else {
    it->~EndingStack();
  }
}

void note_failure(std::exception_ptr failure) {
  const Lock lock(g_failure_mutex);
  if (g_failure == nullptr) g_failure = std::move(failure);
  g_has_failed = true;
}

}  // namespace

void adopt_thread() {
  if (std::exchange(t_is_own, true)) return;
  // A thread that begins when there is no memory still has to say so: its place is taken already.
  alignas(EndingStack) static thread_local std::byte memory[sizeof(EndingStack)];
  auto* const stack = new (memory) EndingStack;
  // The stack of the main thread is never destroyed: the last destructors of the process are of
  // plugins.
  if (gettid() != getpid()) pthread_setspecific(ending_key(), stack);
}

bool is_own_thread() {
  return t_is_own;
}

void keep_own_threads_on(const std::optional<Processors>& processors) {
  g_processors = processors;
}

std::thread own_thread(std::function<void()> body, std::span<const int> taken) {
  sigset_t blocked = all_signals_but({SIGSEGV, SIGBUS, SIGFPE, SIGILL});
  for (const int number : taken) sigdelset(&blocked, number);
  const SignalMask mask(SIG_SETMASK, blocked);
  return std::thread([body = std::move(body), processors = g_processors] {
    adopt_thread();
    if (processors) processors->bind_this_thread();
    try {
      body();
    } catch (const std::exception&) {
      note_failure(std::current_exception());
    }
  });
}

void rethrow_thread_failure() {
  if (!g_has_failed.load(std::memory_order_acquire)) return;
  const Lock lock(g_failure_mutex);
  std::rethrow_exception(g_failure);
}

}  // namespace lockstep::host
