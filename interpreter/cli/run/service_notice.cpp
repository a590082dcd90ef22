#include "cli/run/service_notice.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "base/core/clock.h"
#include "base/core/value.h"
#include "base/system/own_thread.h"

namespace lockstep::host {
namespace {

constexpr Nanoseconds kAgain = std::chrono::milliseconds(50);  // after the socket was full

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string_view() : value;
}

// Twice in the time that WatchdogSec= gives; 0: no watchdog is meant for this process.
Nanoseconds watchdog_interval() {
  const auto process = parse_int(variable("WATCHDOG_PID"));
  const auto microseconds = parse_int(variable("WATCHDOG_USEC"));
  if (!microseconds || *microseconds <= 0 || (process && *process != getpid())) return {};
  constexpr std::int64_t kLongest = std::chrono::microseconds(std::chrono::hours(24)).count();
  return std::chrono::microseconds(std::min(*microseconds, kLongest)) / 2;
}

}  // namespace

std::optional<Problem> ServiceNotice::refusal() {
  const std::string_view name = variable("NOTIFY_SOCKET");
  if (name.empty()) return std::nullopt;
  const bool is_local = name[0] == '/' || name[0] == '@';
  if (is_local && name.size() < sizeof address_.sun_path) return std::nullopt;
  return Problem{"NOTIFY_SOCKET names no socket of this machine", "leave out --notify"};
}

ServiceNotice::ServiceNotice() {
  const std::string_view name = variable("NOTIFY_SOCKET");
  if (name.empty() || refusal()) return;
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, name.data(), name.size());
  if (name[0] == '@') address_.sun_path[0] = '\0';  // an abstract one
  length_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  socket_ = FileDescriptor(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  interval_ = watchdog_interval();
  thread_ = own_thread([this] { watch(); });
}

// False: the manager has not read what was sent before. It is told again. Where it is gone, nobody
// is.
bool ServiceNotice::send(std::string_view state) const {
  if (socket_.number() < 0) return true;
  const auto sent =
      sendto(socket_.number(), state.data(), state.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
             reinterpret_cast<const sockaddr*>(&address_), length_);
  return sent >= 0 || (errno != EAGAIN && errno != ENOBUFS && errno != EINTR);
}

ServiceNotice::~ServiceNotice() {
  stop();
}

void ServiceNotice::run_started(const Moment&, const RunStart& start) {
  if (!send("READY=1")) {
    const Lock lock(mutex_);
    owes_ready_ = true;
    stopped_.notify_all();
  }
  period_.store(std::max<std::int64_t>(1, start.period.count()), std::memory_order_relaxed);
}

void ServiceNotice::before_tick(const Moment&, std::uint64_t tick, Nanoseconds /*time*/) {
  ticks_.store(tick + 1, std::memory_order_relaxed);
  stands_.store(false, std::memory_order_relaxed);
}

void ServiceNotice::standing(const Moment&) {
  stands_.store(true, std::memory_order_relaxed);
}

// Leaves have been halted. What the end waits for has limits.
void ServiceNotice::run_ended(const Moment&, const RunEnd& /*end*/) {
  stop();
  send("STOPPING=1");
}

void ServiceNotice::watch() {
  constexpr Nanoseconds kLong = std::chrono::hours(1);
  const Nanoseconds interval = interval_.count() > 0 ? interval_ : kLong;
  bool owes_life = false;
  Nanoseconds due = monotonic_now() + interval;
  Lock lock(mutex_);
  while (!stop_) {
    const Nanoseconds left = due - monotonic_now();
    lock.wait_for(stopped_, owes_ready_ || owes_life ? std::min(left, kAgain) : left);
    if (stop_) return;
    owes_ready_ = owes_ready_ && !send("READY=1");
    if (monotonic_now() >= due) {
      due += interval;
      owes_life = interval_.count() > 0 && is_alive();
    }
    owes_life = owes_life && !send("WATCHDOG=1");
  }
}

// A tick has begun since the last look, or none had to.
bool ServiceNotice::is_alive() {
  const std::uint64_t ticks = ticks_.load(std::memory_order_relaxed);
  unchanged_ = ticks == seen_ ? unchanged_ + interval_ : Nanoseconds(0);
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
