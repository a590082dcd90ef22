#include "run/watchdog.h"

#include <sys/prctl.h>

#include <algorithm>
#include <condition_variable>
#include <semaphore>
#include <thread>
#include <utility>
#include <vector>

#include "base/core/running_time.h"
#include "base/system/mutex.h"
#include "base/system/own_thread.h"
#include "run/crash_report.h"
#include "run/stop_signals.h"

namespace lockstep::host {
namespace {

// How often to look, so that a limit is noticed soon after it is reached.
Nanoseconds interval_of(const WatchdogOptions& options) {
  Nanoseconds shortest = std::chrono::seconds(1);
  for (const Nanoseconds limit : {options.hang_limit, options.halt_limit}) {
    if (limit > Nanoseconds(0)) shortest = std::min(shortest, limit);
  }
  return RunningTime::interval_for(shortest);
}

}  // namespace

struct Watchdog::Implementation {
  Implementation(WatchdogOptions given, const CallMark& watched)
      : options(std::move(given)), mark(watched), time(interval_of(options), monotonic_now()) {}

  void look();
  Nanoseconds next_look(Nanoseconds now) {
    const Nanoseconds next = now + time.interval();
    return options.alarm == nullptr ? next : std::min(next, options.alarm->look(now));
  }

  const WatchdogOptions options;
  const CallMark& mark;
  RunningTime time;
  CallMark::Look seen;   // at the last look
  Nanoseconds lasts{0};  // how long `seen` has been seen
  bool halt_told = false;
  bool hang_told = false;
};

void Watchdog::Implementation::look() {
  const Nanoseconds elapsed = time.look(monotonic_now());
  const CallMark::Look call = mark.look();
  if (call != seen) {
    seen = call;
    lasts = Nanoseconds(0);
    halt_told = hang_told = false;
    return;
  }
  if (call.function == PluginFunction::None) return;
  lasts += elapsed;
  const auto is_over = [this](Nanoseconds limit) {
    return limit > Nanoseconds(0) && lasts >= limit;
  };
  if (call.function == PluginFunction::Halt && is_over(options.halt_limit) &&
      !std::exchange(halt_told, true) && options.on_long_halt) {
    options.on_long_halt(call, lasts);
  }
  if (!call.is_bounded && is_over(options.hang_limit) && !std::exchange(hang_told, true) &&
      options.on_hang) {
    options.on_hang(call, lasts);
  }
}

// The one thread that looks, there as long as there is a watchdog.
class Watchdog::Patrol {
 public:
  // Never destroyed: it works to the very end of the process.
  static Patrol& instance() {
    static auto& patrol = *new Patrol;
    return patrol;
  }
  void add(Implementation& watched);
  void remove(const Implementation& watched);

 private:
  void work();

  Mutex changing_;  // who adds and removes
  std::thread thread_ LOCKSTEP_GUARDED_BY(changing_);
  std::binary_semaphore ready_{0};  // of the thread
  Mutex mutex_;
  std::condition_variable changed_;
  std::vector<Implementation*> watched_ LOCKSTEP_GUARDED_BY(mutex_);
};

void Watchdog::Patrol::add(Implementation& watched) {
  const Lock change(changing_);
  {
    const Lock lock(mutex_);
    watched_.push_back(&watched);
  }
  changed_.notify_one();  // which may have to look more often
  if (thread_.joinable()) return;
  try {
    const bool handles_signals = watched.options.handles_signals;
    thread_ = own_thread([this] { work(); },
                         handles_signals ? StopSignals::numbers() : std::span<const int>());
  } catch (...) {
    const Lock lock(mutex_);
    watched_.clear();
    throw;
  }
  ready_.acquire();
}

void Watchdog::Patrol::remove(const Implementation& watched) {
  const Lock change(changing_);
  bool is_last = false;
  {
    const Lock lock(mutex_);
    std::erase(watched_, &watched);
    is_last = watched_.empty();
  }
  if (!is_last) return;
  changed_.notify_one();
  thread_.join();
}

void Watchdog::Patrol::work() {
  // To begin takes a lock of the dynamic linker, which a plugin that hangs while it is loaded
  // keeps.
  ready_.release();
  prctl(PR_SET_TIMERSLACK, 1, 0, 0, 0);  // an alarm is to ring in time
  Lock lock(mutex_);
  while (!watched_.empty()) {
    const Nanoseconds now = monotonic_now();
    Nanoseconds next = Nanoseconds::max();
    for (Implementation* it : watched_) next = std::min(next, it->next_look(now));
    lock.wait_for(changed_, next - now);
    for (Implementation* it : watched_) it->look();
  }
}

Watchdog::Watchdog(WatchdogOptions options)
    : it_(std::make_unique<Implementation>(std::move(options), CallMark::this_thread())) {
  Patrol::instance().add(*it_);
}

Watchdog::~Watchdog() {
  Patrol::instance().remove(*it_);
}

WatchdogOptions ends_process(Nanoseconds hang_limit) {
  return {.hang_limit = hang_limit,
          .halt_limit = Nanoseconds(0),
          .on_hang = [thread = pthread_self(), &mark = CallMark::this_thread()](
                         const CallMark::Look&, Nanoseconds lasts) {
            CrashReport::hang(thread, mark, to_seconds(lasts));
          }};
}

}  // namespace lockstep::host
