#include "runtime/watchdog.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "core/own_thread.h"
#include "runtime/stop_signals.h"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

// How often to look, so that a limit is noticed soon after it is reached.
Nanoseconds interval_of(const WatchdogOptions& options) {
  Nanoseconds shortest = 800ms;
  for (const Nanoseconds limit : {options.hang_limit, options.halt_limit}) {
    if (limit > Nanoseconds(0)) shortest = std::min(shortest, limit);
  }
  return std::clamp<Nanoseconds>(shortest / 8, 10ms, 100ms);
}

}  // namespace

struct Watchdog::Implementation {
  Implementation(WatchdogOptions given, const CallMark& watched);
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void watch();
  void look(Nanoseconds elapsed);

  const WatchdogOptions options;
  const Nanoseconds interval;
  const CallMark& mark;
  CallMark::Look seen;   // at the last look
  Nanoseconds lasts{0};  // how long `seen` has been seen
  bool halt_told = false;
  bool hang_told = false;

  std::mutex mutex;
  std::condition_variable ended;
  bool must_end = false;
  std::thread thread;
};

Watchdog::Implementation::Implementation(WatchdogOptions given, const CallMark& watched)
    : options(std::move(given)), interval(interval_of(options)), mark(watched) {
  thread = own_thread([this] { watch(); }, StopSignals::numbers());
}

Watchdog::Implementation::~Implementation() {
  {
    const std::lock_guard lock(mutex);
    must_end = true;
  }
  ended.notify_one();
  thread.join();
}

void Watchdog::Implementation::watch() {
  WallClock clock;
  Nanoseconds last_look = clock.now();
  std::unique_lock lock(mutex);
  while (!ended.wait_for(lock, interval, [this] { return must_end; })) {
    lock.unlock();
    const Nanoseconds now = clock.now();
    look(now - last_look);
    last_look = now;
    lock.lock();
  }
}

void Watchdog::Implementation::look(Nanoseconds elapsed) {
  const CallMark::Look call = mark.look();
  if (call != seen) {
    seen = call;
    lasts = Nanoseconds(0);
    halt_told = hang_told = false;
    return;
  }
  if (call.function() == PluginFunction::None) return;
  // When this thread was late, the whole process may have been stopped, in a debugger or by a
  // signal: that is not the leaf's time.
  lasts += std::min(elapsed, 2 * interval);
  const auto is_over = [this](Nanoseconds limit) {
    return limit > Nanoseconds(0) && lasts >= limit;
  };
  if (call.function() == PluginFunction::Halt && is_over(options.halt_limit) &&
      !std::exchange(halt_told, true) && options.on_long_halt) {
    options.on_long_halt(call, lasts);
  }
  if (!call.is_bounded() && is_over(options.hang_limit) && !std::exchange(hang_told, true) &&
      options.on_hang) {
    options.on_hang(call, lasts);
  }
}

Watchdog::Watchdog(WatchdogOptions options)
    : it_(std::make_unique<Implementation>(std::move(options), CallMark::this_thread())) {}

Watchdog::~Watchdog() = default;

}  // namespace lockstep
