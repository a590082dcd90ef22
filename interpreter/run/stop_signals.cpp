#include "run/stop_signals.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <iterator>

#include "base/core/clock.h"
#include "base/system/fork_guard.h"
#include "run/fuse.h"

namespace lockstep::host {
namespace {

constexpr int kNumbers[] = {SIGINT,  SIGQUIT, SIGTERM,   SIGHUP,  SIGUSR1, SIGUSR2,  SIGALRM,
                            SIGXCPU, SIGIO,   SIGVTALRM, SIGPROF, SIGPWR,  SIGSTKFLT};
// Sent by a person or for one: the first three. Timers, limits and terminals that close repeat the
// others by themselves.
constexpr std::span<const int> kOfPeople(kNumbers, 3);
// timeout(1) and wrappers that pass on what the terminal sends to all send twice at once.
constexpr Nanoseconds kEcho = std::chrono::milliseconds(50);

std::atomic<int> g_received{0};
std::atomic<Nanoseconds> g_time{Nanoseconds(0)};  // of it
void (*g_last_words)() = nullptr;                 // written before the handlers are installed
static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<Nanoseconds>::is_always_lock_free);

bool is_of_people(int number) {
  return std::ranges::find(kOfPeople, number) != kOfPeople.end();
}

void on_signal(int number) {
  if (ForkGuard::is_child()) {  // of a plugin: it has nothing to halt or to save
    signal(number, SIG_DFL);
    raise(number);
    return;
  }
  int none = 0;
  const Nanoseconds now = monotonic_now();
  if (g_time.load() == Nanoseconds(0)) g_time = now;
  if (g_received.compare_exchange_strong(none, number)) return;
  const bool is_echo = number == g_received && now - g_time.load() < kEcho;
  if (is_echo || !is_of_people(number)) return;
  light_fuse(1, {.exit_code = 128 + number});
  if (g_last_words != nullptr) g_last_words();
  end_at_once(128 + number);
}

}  // namespace

void StopSignals::install(void (*last_words)()) {
  g_last_words = last_words;
  struct sigaction action {};
  action.sa_handler = on_signal;  // without SA_RESTART: it must end a sleep
  // One after another: of two that come together the second would be handled first.
  for (const int number : kNumbers) sigaddset(&action.sa_mask, number);
  for (const int number : kNumbers) {
    struct sigaction before {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler == SIG_DFL || is_of_people(number)) sigaction(number, &action, nullptr);
  }
}

int StopSignals::received() {
  return g_received.load(std::memory_order_relaxed);
}

std::span<const int> StopSignals::numbers() {
  return kNumbers;
}

}  // namespace lockstep::host
