#include "plugin/isolated/session.h"

#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "plugin/host.h"

namespace lockstep {
namespace {

constexpr Nanoseconds kPatience = std::chrono::seconds(2);  // for a killed process to be gone

// Owns a descriptor for the time of its scope.
struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

// A thread that no signal interrupts: they are for the program's own threads.
template <class Function>
std::thread quiet_thread(Function function) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(function);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

bool take_rings(int lifeline) {
  char bytes[64];
  const auto count = recv(lifeline, bytes, sizeof bytes, MSG_DONTWAIT);
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

}  // namespace

std::string Session::start(const IsolationOptions& options, const std::string& plugin) {
  hang_limit_ = options.hang_limit;
  const Descriptor memory{Channel::create_memory()};
  Descriptor ends[2];
  int pair[2];
  const bool connected = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) == 0;
  if (connected) ends[0].number = pair[0], ends[1].number = pair[1];
  if (memory.number < 0 || !connected || !channel_.open(memory.number, Channel::Side::Host)) {
    return std::strerror(errno);  // NOLINT(concurrency-mt-unsafe): known errors, constant texts
  }
  log_.emplace(channel_.log_ring());
  std::string failure = process_.start(options.leafhost, plugin, memory.number, ends[1].number);
  if (!failure.empty()) return failure;
  lifeline_ = std::exchange(ends[0].number, -1);
  watcher_ = quiet_thread([this] { watch(); });
  return {};
}

Session::~Session() {
  if (watcher_.joinable()) {
    process_.kill();
    watcher_.join();
  }
  if (lifeline_ >= 0) close(lifeline_);
}

// The watcher's thread: lines from threads of the plugin, and the end of the process.
void Session::watch() {
  pollfd ends[2] = {{process_.descriptor(), POLLIN, 0}, {lifeline_, POLLIN, 0}};
  while (ends[0].revents == 0) {
    if (poll(ends, 2, -1) < 0) continue;
    if (ends[1].revents != 0) {
      if (!take_rings(lifeline_)) ends[1].fd = -1;  // the plugin has closed it
      drain_log();
    }
  }
  std::string death = process_.reap();
  drain_log();
  {
    const std::lock_guard lock(gone_mutex_);
    death_ = std::move(death);
    gone_.store(true);
  }
  gone_signal_.notify_all();
  channel_.wake();
}

void Session::await_end(std::optional<Nanoseconds> patience) {
  std::unique_lock lock(gone_mutex_);
  const auto is_over = [this] { return gone_.load(); };
  if (patience) {
    gone_signal_.wait_for(lock, *patience, is_over);
  } else {
    gone_signal_.wait(lock, is_over);
  }
}

void Session::drain_log() {
  const std::lock_guard lock(log_mutex_);
  if (log_->empty()) return;
  const lockstep_caller* last = nullptr;
  log_->drain([&](std::uint32_t number, lockstep_log_level level, const char* text) {
    const auto* const caller = number < listeners_.size() ? listeners_[number] : nullptr;
    if (caller == nullptr) return;
    host_table().log(caller, level, text);
    last = caller;
  });
  const std::uint32_t lost = log_->take_lost();
  if (lost == 0 || last == nullptr) return;
  const auto text = fmt::format("{} lines are lost: it logs faster than they can be shown", lost);
  host_table().log(last, LOCKSTEP_LOG_WARNING, text.c_str());
}

void Session::set_listener(std::uint32_t number, const lockstep_caller* caller) {
  drain_log();
  const std::lock_guard lock(log_mutex_);
  if (number >= listeners_.size()) listeners_.resize(number + std::size_t{1});
  listeners_[number] = caller;
}

MessageWriter& Session::begin_request(PluginFunction function) {
  function_ = function;
  request_.clear();
  request_.put(function);
  return request_;
}

std::optional<Nanoseconds> Session::deadline() const {
  if (hang_limit_ == Nanoseconds(0)) return std::nullopt;
  return monotonic_now() + hang_limit_;
}

bool Session::call(std::string_view who) {
  if (is_gone()) {
    last_words_ = epitaph();
    return false;
  }
  CallMark::this_thread().set_bounded();  // by hang_limit_
  channel_.send(request_.bytes());
  const auto result = channel_.wait(deadline(), gone_);
  if (result == Channel::Wait::Received) {
    drain_log();
    return true;
  }
  fail_call(who, result == Channel::Wait::Late ? Ending::Late : Ending::None);
  return false;
}

void Session::fail_call(std::string_view who, Ending ending) {
  const char* const function = name_of(function_);
  const std::string where = who.empty() ? "" : fmt::format(" of '{}'", who);
  if (ending != Ending::None) {
    given_up_ = true;
    process_.kill();
    await_end(kPatience);  // its last lines come before the fault
  }
  if (ending == Ending::Late) {
    const double limit = to_seconds(hang_limit_);
    last_words_ =
        fmt::format("did not return from {} for {:g} s; its process was killed", function, limit);
    blame_ =
        fmt::format("was killed because {}{} did not return for {:g} s", function, where, limit);
  } else if (ending == Ending::Nonsense) {
    last_words_ = "its process answered with bytes that make no sense; it was killed";
    blame_ = fmt::format("was killed because its answer to {}{} made no sense", function, where);
  } else {
    last_words_ = "its process " + death_;
    blame_ = fmt::format("{} in {}{}", death_, function, where);
  }
}

MessageReader Session::answer() {
  const auto bytes = channel_.received();
  return MessageReader(bytes ? *bytes : std::span<const std::byte>{});
}

void Session::reject_answer() {
  fail_call({}, Ending::Nonsense);
}

std::string Session::epitaph() const {
  return "its process is gone: it " + (blame_.empty() ? death_ : blame_);
}

void Session::end() {
  if (is_gone()) return;
  begin_request(PluginFunction::Deinit);
  if (!call({})) return;
  // After that the destructor sees to it.
  await_end(hang_limit_ == Nanoseconds(0) ? std::nullopt : std::optional(hang_limit_));
}

}  // namespace lockstep
