#include "observers/append_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <system_error>

#include "observers/quiet_thread.h"

namespace lockstep {
namespace {

// For emergency_flush(). A process has one recording, rarely more; those that find no place here
// are not saved in an emergency.
std::array<std::atomic<AppendFile*>, 8> open_files;
std::atomic<int> emergencies{0};

void enter(AppendFile* file) {
  for (auto& place : open_files) {
    AppendFile* nobody = nullptr;
    if (place.compare_exchange_strong(nobody, file)) return;
  }
}

void nap() {
  const timespec time{.tv_sec = 0, .tv_nsec = 1'000'000};
  nanosleep(&time, nullptr);
}

// The file must not go away while a crash handler of another thread works with it.
void leave(AppendFile* file) {
  for (auto& place : open_files) {
    AppendFile* mine = file;
    place.compare_exchange_strong(mine, nullptr);
  }
  while (emergencies.load() != 0) nap();
}

// As async-signal-safe as clock_gettime.
std::chrono::nanoseconds now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

AppendFile::AppendFile(const std::string& path, std::size_t queue) : path_(path), ring_(queue) {
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) {
    fail("open");
    return;
  }
  thread_ = quiet_thread([this] { write_until_stopped(); });
  enter(this);
}

AppendFile::~AppendFile() {
  if (file_ < 0) return;
  stopping_.store(true, std::memory_order_release);
  work_.ring();
  thread_.join();
  leave(this);
  ::close(file_);
}

const std::string& AppendFile::error() const {
  static const std::string kNone;
  return failed() ? error_ : kNone;
}

bool AppendFile::push(std::string_view lines) {
  if (failed() || !ring_.push(lines)) return false;
  const std::uint64_t pushed = ring_.pushed();
  if (pushed - called_for_ >= kFull) {
    called_for_ = pushed;
    work_.ring();
  }
  return true;
}

void AppendFile::write(std::string_view lines) {
  flush();
  if (failed()) return;
  ring_.grow(lines.size());
  ring_.push(lines);
  flush();
}

void AppendFile::flush() {
  while (true) {
    const std::uint32_t seen = done_.rung();
    if (failed() || ring_.empty()) return;
    work_.ring();
    done_.wait(seen, kLongestDelay);
  }
}

void AppendFile::write_until_stopped() {
  while (true) {
    const std::uint32_t seen = work_.rung();
    const bool last = stopping_.load(std::memory_order_acquire);
    if (claim()) {
      write_out(Failure::Told);
      release();
    }
    done_.ring();
    if (last) return;
    work_.wait(seen, kLongestDelay);
  }
}

// Nothing is written after an error: a gap in the middle would be worse than a short file.
void AppendFile::write_out(Failure failure) {
  while (!failed() && !ring_.empty()) write_some(failure);
}

void AppendFile::write_some(Failure failure) {
  const auto [first, second] = ring_.front();
  // writev does not write to what it is given.
  const std::array<iovec, 2> pieces{{{const_cast<char*>(first.data()), first.size()},
                                     {const_cast<char*>(second.data()), second.size()}}};
  const ssize_t written = ::writev(file_, pieces.data(), second.empty() ? 1 : 2);
  if (written >= 0) return count_written(static_cast<std::size_t>(written));
  if (errno == EINTR) return;
  const int reason = errno;
  cut_back();
  errno = reason;
  if (failure == Failure::Told) return fail("write");
  failed_.store(true, std::memory_order_release);
}

void AppendFile::count_written(std::size_t count) {
  const auto [first, second] = ring_.front();
  const std::string_view of_first = first.substr(0, count);
  const std::string_view of_second = second.substr(0, count - of_first.size());
  unfinished_ += count;
  if (const auto newline = of_second.rfind('\n'); newline != std::string_view::npos) {
    unfinished_ = of_second.size() - newline - 1;
  } else if (const auto earlier = of_first.rfind('\n'); earlier != std::string_view::npos) {
    unfinished_ = count - earlier - 1;
  }
  ring_.take(count);
}

// A disk that fills up takes a part of a line. Counted from the end: somebody may have emptied the
// file meanwhile.
void AppendFile::cut_back() {
  const off_t end = ::lseek(file_, 0, SEEK_END);
  const auto unfinished = static_cast<off_t>(unfinished_);
  // If even that fails, readers know what to do with half a line.
  if (unfinished > 0 && end >= unfinished && ::ftruncate(file_, end - unfinished) == 0) {
    unfinished_ = 0;
  }
}

void AppendFile::fail(const char* what) {
  const std::string reason = std::generic_category().message(errno);
  error_ = fmt::format("cannot {} '{}': {}", what, path_, reason);
  failed_.store(true, std::memory_order_release);
}

void AppendFile::emergency_flush() {
  const int before = errno;
  ++emergencies;
  const auto deadline = now() + kLongestEmergency;
  for (auto& place : open_files) {
    if (AppendFile* file = place.load()) file->save(deadline);
  }
  --emergencies;
  errno = before;
}

void AppendFile::save(std::chrono::nanoseconds deadline) {
  // Later lines, of a tick thread that still runs, are not waited for: it might never end.
  const std::uint64_t until = ring_.pushed();
  const auto is_done = [&] { return failed() || ring_.taken() >= until; };
  // When the crash is in the thread that writes, there is nobody to wait for.
  const bool mine = claim_.load() == gettid();
  work_.ring();
  while (!mine && !is_done() && now() < deadline) nap();
  if (is_done() || !(mine || claim())) return;
  // A pipe that nobody reads must not hold up the end of the process.
  ::fcntl(file_, F_SETFL, O_APPEND | O_NONBLOCK);
  write_out(Failure::Silent);
  release();
}

bool AppendFile::claim() {
  pid_t nobody = 0;
  return claim_.compare_exchange_strong(nobody, gettid(), std::memory_order_acquire);
}

void AppendFile::release() {
  claim_.store(0, std::memory_order_release);
}

}  // namespace lockstep
