#include "core/own_thread.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <utility>

#include "core/alternate_stack.h"
#include "core/signal_mask.h"

namespace lockstep {
namespace {

constinit thread_local bool t_is_own = false;

std::atomic<bool> g_has_failed{false};
std::mutex g_failure_mutex;
std::exception_ptr g_failure;  // the first

void note_failure(std::exception_ptr failure) {
  const std::lock_guard lock(g_failure_mutex);
  if (g_failure == nullptr) g_failure = std::move(failure);
  g_has_failed = true;
}

}  // namespace

void adopt_thread() {
  static thread_local const AlternateStack stack;
  t_is_own = true;
}

bool is_own_thread() {
  return t_is_own;
}

std::thread own_thread(std::function<void()> body, std::span<const int> taken) {
  sigset_t blocked = all_signals_but({SIGSEGV, SIGBUS, SIGFPE, SIGILL});
  for (const int number : taken) sigdelset(&blocked, number);
  const SignalMask mask(SIG_SETMASK, blocked);
  return std::thread([body = std::move(body)] {
    adopt_thread();
    try {
      body();
    } catch (const std::exception&) {
      note_failure(std::current_exception());
    }
  });
}

void rethrow_thread_failure() {
  if (!g_has_failed.load(std::memory_order_acquire)) return;
  const std::lock_guard lock(g_failure_mutex);
  std::rethrow_exception(g_failure);
}

}  // namespace lockstep
