#include "leaves/remote/shared_memory/session.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>

#include <cerrno>

#include "base/core/running_time.h"
#include "base/system/own_thread.h"
#include "base/system/process_end.h"
#include "leaves/plugin/contract/leaf_set.h"
#include "leaves/remote/shared_memory/leafhost_descriptors.h"

namespace lockstep::host {
namespace {

constexpr Nanoseconds kPatience = std::chrono::seconds(2);  // for a killed process to be gone
// Threads of a plugin may log so many lines at once, and so many milliseconds apart.
constexpr std::size_t kMostLines = 100;
constexpr int kPause = 100;

}  // namespace

std::string Session::start(const IsolationOptions& options, const std::string& plugin) {
  hang_limit_ = options.hang_limit;
  const FileDescriptor memory(Channel::create_memory());
  bell_ = FileDescriptor(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  const FileDescriptor end = ProcessEnd::own();
  if (memory.number() < 0 || bell_.number() < 0 || end.number() < 0 ||
      !channel_.open(memory.number(), Channel::Side::Host)) {
    return error_text(errno);
  }
  call_log_.open(channel_.call_log());
  thread_log_.open(channel_.thread_log());
  const ChildProcess::Given given[] = {{memory.number(), LeafhostDescriptors::kMemory},
                                       {bell_.number(), LeafhostDescriptors::kBell},
                                       {end.number(), LeafhostDescriptors::kParent}};
  std::string failure = process_.start(options.leafhost, {"lockstep-leafhost", plugin}, given);
  if (!failure.empty()) return failure;
  watcher_ = own_thread([this]() noexcept { watch(); });
  return {};
}

Session::~Session() {
  if (watcher_.joinable()) {
    process_.kill();
    watcher_.join();
  }
}

// The watcher's thread: lines from threads of the plugin, which must not keep the tick thread, and
// the end of the process.
void Session::watch() {
  pollfd ends[2] = {{process_.descriptor(), POLLIN, 0}, {bell_.number(), POLLIN, 0}};
  bool has_more = false;
  do {
    poll(ends, 2, has_more ? 0 : -1);
    eventfd_t rings = 0;
    eventfd_read(bell_.number(), &rings);
    has_more = drain(call_log_, kMostLines);  // of a call that goes on
    has_more |= drain(thread_log_, kMostLines);
    poll(ends, 1, kPause);
  } while (ends[0].revents == 0);
  std::string death = process_.reap();
  drain(call_log_);
  drain(thread_log_);
  {
    const Lock lock(gone_mutex_);
    death_ = std::move(death);
    gone_.store(true);
  }
  gone_signal_.notify_all();
  channel_.wake();
}

void Session::await_end(std::optional<Nanoseconds> patience) {
  Lock lock(gone_mutex_);
  RunningTime time(RunningTime::interval_for(patience.value_or(kPatience)), monotonic_now());
  for (Nanoseconds waited{0}; !gone_ && (!patience || waited < *patience);
       waited += time.look(monotonic_now())) {
    lock.wait_for(gone_signal_, time.interval());
  }
}

std::string Session::death() const {
  const Lock lock(gone_mutex_);
  return death_;
}

// A lock for each line: who has a leaf to add must not wait until many are shown.
void Session::tell(std::uint32_t number, lockstep_log_level level, const char* text) {
  const Lock lock(listeners_mutex_);
  const auto* const caller = number < listeners_.size() ? listeners_[number] : nullptr;
  if (caller != nullptr) host_table().log(caller, level, text);
}

// True when there is more.
bool Session::drain(Log& log, std::size_t most) {
  const Lock lock(log.mutex);
  if (log.reader->empty()) return false;
  std::uint32_t last = 0;
  log.reader->drain(
      [&](std::uint32_t number, lockstep_log_level level, const char* text) {
        tell(number, level, text);
        last = number;
      },
      most);
  if (const std::uint32_t lost = log.reader->take_lost(); lost != 0) {
    const auto text = fmt::format("{} lines are lost: it logs faster than they can be shown", lost);
    tell(last, LOCKSTEP_LOG_WARNING, text.c_str());
  }
  return !log.reader->empty();
}

void Session::add_listener(std::uint32_t number, const lockstep_caller& caller) {
  const Lock lock(listeners_mutex_);
  if (number >= listeners_.size()) listeners_.resize(number + std::size_t{1});
  listeners_[number] = &caller;
}

void Session::forget_listeners() {
  drain(call_log_);
  drain(thread_log_);
  const Lock lock(listeners_mutex_);
  listeners_.clear();
}

MessageWriter& Session::begin_request(PluginFunction function) {
  function_ = function;
  request_.clear();
  request_.put(function);
  return request_;
}

std::optional<Nanoseconds> Session::limit() const {
  return hang_limit_ == Nanoseconds(0) ? std::nullopt : std::optional(hang_limit_);
}

bool Session::call(std::string_view who) {
  if (is_gone()) {
    last_words_ = epitaph();
    return false;
  }
  CallMark::this_thread().set_bounded();  // by hang_limit_
  channel_.send(request_.bytes());
  const auto result = channel_.wait(limit(), gone_);
  if (result == Channel::Wait::Received) {
    drain(call_log_);
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
    last_words_ = "its process sent an invalid answer; it was killed";
    blame_ = fmt::format("was killed because its answer to {}{} was invalid", function, where);
  } else {
    last_words_ = "its process " + death();
    blame_ = fmt::format("{} in {}{}", death(), function, where);
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
  return "its process is gone: it " + (blame_.empty() ? death() : blame_);
}

void Session::end() {
  if (is_gone()) return;
  begin_request(PluginFunction::Deinit);
  if (!call({})) return;
  await_end(limit());  // after that the destructor sees to it
}

}  // namespace lockstep::host
