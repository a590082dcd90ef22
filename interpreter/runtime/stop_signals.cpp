#include "runtime/stop_signals.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace lockstep {
namespace {

std::atomic<int> g_received{0};
void (*g_last_words)() = nullptr;  // written before the handlers are installed
static_assert(std::atomic<int>::is_always_lock_free);

void on_signal(int number) {
  int none = 0;
  if (g_received.compare_exchange_strong(none, number)) return;
  if (g_last_words != nullptr) g_last_words();
  _exit(128 + number);
}

}  // namespace

void StopSignals::install(void (*last_words)()) {
  g_last_words = last_words;
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);  // without SA_RESTART: it must end a sleep
  sigaction(SIGTERM, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
}

int StopSignals::received() {
  return g_received.load(std::memory_order_relaxed);
}

}  // namespace lockstep
