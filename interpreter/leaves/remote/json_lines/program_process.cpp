#include "leaves/remote/json_lines/program_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <initializer_list>
#include <utility>

#include "base/system/pipe.h"
#include "base/system/process_end.h"
#include "leaves/remote/json_lines/guardian.h"
#include "leaves/remote/json_lines/orphans.h"

namespace lockstep::host {
namespace {

constexpr Nanoseconds kPatience = std::chrono::seconds(2);  // for a process that was killed
constexpr Nanoseconds kToRead = std::chrono::seconds(2);    // some of what was written

// Waits until one of the descriptors is readable, or this one, if any, is writable. Signals do not
// end the wait.
bool await(std::initializer_list<int> descriptors, std::optional<Nanoseconds> patience,
           int writable = -1) {
  const Nanoseconds end = monotonic_now() + patience.value_or(Nanoseconds(0));
  pollfd awaited[3];
  nfds_t count = 0;
  for (const int descriptor : descriptors) awaited[count++] = {descriptor, POLLIN, 0};
  awaited[count++] = {writable, POLLOUT, 0};
  while (true) {
    timespec left{};
    if (patience) {
      const Nanoseconds rest = std::max(end - monotonic_now(), Nanoseconds(0));
      left = {rest.count() / 1'000'000'000, rest.count() % 1'000'000'000};
    }
    const int ready = ppoll(awaited, count, patience ? &left : nullptr, nullptr);
    if (ready > 0) return true;
    if (ready == 0) return false;
  }
}

}  // namespace

std::string ProgramProcess::start(const std::string& leafhost, const std::string& path) {
  Pipe requests, answers, control;
  const FileDescriptor parent = ProcessEnd::own();
  if (parent.number() < 0 || !requests.open_sockets(SOCK_STREAM) || !answers.open() ||
      !control.open_sockets(SOCK_SEQPACKET)) {
    return error_text(errno);
  }
  control_ = std::move(control.reading);
  const ChildProcess::Given given[] = {{requests.reading.number(), GuardianDescriptors::kRequests},
                                       {answers.writing.number(), GuardianDescriptors::kAnswers},
                                       {control.writing.number(), GuardianDescriptors::kControl},
                                       {parent.number(), GuardianDescriptors::kParent}};
  if (auto failure = guardian_.start(leafhost, {"lockstep-leafhost", "--program", path}, given);
      !failure.empty()) {
    return failure;
  }
  input_ = std::move(requests.writing);
  output_ = std::move(answers.reading);
  fcntl(output_.number(), F_SETFL, O_RDONLY | O_NONBLOCK);
  GuardianReport report{};
  const bool reported = await({control_.number()}, kPatience) &&
                        recv(control_.number(), &report, sizeof report, 0) == sizeof report;
  if (!reported) return "its guardian does not start";
  if (report.what == GuardianReport::What::NotStarted) return error_text(report.number);
  const Lock lock(mutex_);
  group_ = report.number;
  return {};
}

bool ProgramProcess::has_started() {
  const Lock lock(mutex_);
  return group_ > 0;
}

ProgramProcess::~ProgramProcess() {
  bury();
}

// The guardian ends what it guards when nobody holds the other end of its socket.
void ProgramProcess::bury() {
  if (is_buried_ || guardian_.descriptor() < 0) return;
  is_buried_ = true;
  pid_t group = -1;
  {
    const Lock lock(mutex_);
    group = std::exchange(group_, -1);
    shutdown(control_.number(), SHUT_RDWR);
  }
  if (!await({guardian_.descriptor()}, kPatience)) guardian_.kill();
  const pid_t guardian = guardian_.number();
  if (guardian_.reap() != "ended with exit code 0") end_orphans_of(guardian, group);
}

ProgramProcess::Written ProgramProcess::write(std::string_view text) {
  const Nanoseconds now = clock_.now();
  if (unwritten_.empty()) taken_ = now;
  unwritten_ += text;
  std::size_t done = 0;
  while (done < unwritten_.size()) {
    const ssize_t count = send(input_.number(), unwritten_.data() + done, unwritten_.size() - done,
                               MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN) {
      break;
    } else if (errno != EINTR) {
      unwritten_.clear();
      return Written::Deaf;
    }
  }
  unwritten_.erase(0, done);
  if (done > 0) taken_ = now;
  const bool is_too_much = unwritten_.size() > kMostUnwritten && now - taken_ > kToRead;
  return is_too_much ? Written::TooMuch : Written::Good;
}

// Also where a forked child of ours has a copy of it.
void ProgramProcess::close_input() {
  shutdown(input_.number(), SHUT_WR);
  input_ = FileDescriptor();
}

bool ProgramProcess::await_output(std::optional<Nanoseconds> patience) const {
  return await({output_.number(), control_.number()}, patience,
               has_unwritten() ? input_.number() : -1);
}

bool ProgramProcess::has_ended() const {
  return end_.has_value() || await({control_.number()}, Nanoseconds(0));
}

void ProgramProcess::end_softly(std::optional<Nanoseconds> limit) {
  const GuardianOrder order{limit ? limit->count() : -1};
  send(control_.number(), &order, sizeof order, MSG_NOSIGNAL | MSG_DONTWAIT);
}

// The guardian keeps the number of the group for us until the end of control_.
void ProgramProcess::signal(int number) {
  const Lock lock(mutex_);
  if (group_ > 0) ::kill(-group_, number);
}

std::optional<std::string> ProgramProcess::await_end(std::optional<Nanoseconds> patience) {
  if (end_) return end_;
  if (!await({control_.number()}, patience)) return std::nullopt;
  GuardianReport report{};
  if (recv(control_.number(), &report, sizeof report, 0) == sizeof report) {
    end_ = describe_end(report.number, report.status);
  } else {
    kill();
    end_ = "was killed: its guardian has died";
  }
  return end_;
}

}  // namespace lockstep::host
