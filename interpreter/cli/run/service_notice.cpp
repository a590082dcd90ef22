#include "cli/run/service_notice.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "system/late_library.h"
#include "system/own_thread.h"

namespace lockstep::host {
namespace {

// On every machine whose services it starts.
struct Systemd : LateLibrary {
  Systemd() : LateLibrary("libsystemd.so.0") {}
  int (*notify)(int unset_environment, const char* state) = function("sd_notify");
  int (*watchdog)(int unset_environment,
                  std::uint64_t* microseconds) = function("sd_watchdog_enabled");
};

const Systemd& systemd() {
  static const Systemd library;
  return library;
}

bool is_wanted() {
  return std::getenv("NOTIFY_SOCKET") != nullptr;
}

void tell(const char* state) {
  if (is_wanted()) systemd().notify(0, state);
}

}  // namespace

std::optional<Problem> ServiceNotice::refusal() {
  if (!is_wanted()) return std::nullopt;
  try {
    systemd();
  } catch (const std::runtime_error& error) {
    return Problem{error.what(), "install libsystemd0, or leave out --notify"};
  }
  return std::nullopt;
}

ServiceNotice::ServiceNotice() {
  std::uint64_t microseconds = 0;
  if (!is_wanted() || systemd().watchdog(0, &microseconds) <= 0) return;
  const Nanoseconds interval = std::chrono::microseconds(microseconds) / 2;
  thread_ = own_thread([this, interval] { watch(interval); });
}

ServiceNotice::~ServiceNotice() {
  stop();
}

void ServiceNotice::run_started(Ticker& /*ticker*/, const RunStart& start) {
  tell("READY=1");
  period_.store(std::max<std::int64_t>(1, start.period.count()), std::memory_order_relaxed);
}

void ServiceNotice::before_tick(Ticker& /*ticker*/, std::uint64_t tick, Nanoseconds /*time*/) {
  ticks_.store(tick + 1, std::memory_order_relaxed);
  stands_.store(false, std::memory_order_relaxed);
}

void ServiceNotice::standing(Ticker& /*ticker*/) {
  stands_.store(true, std::memory_order_relaxed);
}

// Leaves have been halted. What the end waits for has limits.
void ServiceNotice::run_ended(Ticker& /*ticker*/, const RunEnd& /*end*/) {
  stop();
  tell("STOPPING=1");
}

void ServiceNotice::watch(Nanoseconds interval) {
  Lock lock(mutex_);
  while (!stop_) {
    lock.wait_for(stopped_, interval);
    if (!stop_ && is_alive(interval)) tell("WATCHDOG=1");
  }
}

// A tick has begun since the last look, or none had to.
bool ServiceNotice::is_alive(Nanoseconds interval) {
  const std::uint64_t ticks = ticks_.load(std::memory_order_relaxed);
  unchanged_ = ticks == seen_ ? unchanged_ + interval : Nanoseconds(0);
  seen_ = ticks;
  const std::int64_t period = period_.load(std::memory_order_relaxed);
  if (period == 0) return false;
  return unchanged_.count() <= period || stands_.load(std::memory_order_relaxed);
}

void ServiceNotice::stop() {
  {
    const Lock lock(mutex_);
    stop_ = true;
  }
  stopped_.notify_all();
  if (thread_.joinable()) thread_.join();
}

}  // namespace lockstep::host
