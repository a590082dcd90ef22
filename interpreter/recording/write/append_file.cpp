#include "recording/write/append_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <new>
#include <stdexcept>
#include <system_error>

#include "core/clock.h"
#include "live/packet_printer.h"
#include "system/own_thread.h"

namespace lockstep::host {
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

// A pipe or a device that has no room says so, instead of waiting.
void make_nonblocking(int file) {
  struct stat status {};
  if (fstat(file, &status) == 0 && !S_ISREG(status.st_mode)) {
    ::fcntl(file, F_SETFL, O_APPEND | O_NONBLOCK);
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

}  // namespace

AppendFile::AppendFile(const std::string& path, std::size_t queue, const LineFormat& format,
                       Compression compression)
    : ring_(queue),
      format_(format),
      path_(path),
      out_(path),
      file_(out_.descriptor()),
      text_(kText) {
  if (file_ < 0) {
    error_ = out_.error();
    failed_.store(true, std::memory_order_release);
    return;
  }
  try {
    if (compression == Compression::Zstd) frames_.emplace(kText);
  } catch (const std::runtime_error& missing) {  // there is no such library
    error_ = fmt::format("cannot write '{}': {}", path, missing.what());
    failed_.store(true, std::memory_order_release);
    return;
  }
  make_nonblocking(file_);
  thread_ = own_thread([this] {
    try {
      write_until_stopped();
    } catch (const std::bad_alloc&) {  // what waits for the file must not wait for ever
      error_ = "out of memory";
      failed_.store(true, std::memory_order_release);
      done_.ring();
      throw;
    }
  });
  enter(this);
}

AppendFile::~AppendFile() {
  if (!thread_.joinable()) return;
  stopping_.store(true, std::memory_order_release);
  work_.ring();
  thread_.join();
  leave(this);
}

const std::string& AppendFile::error() const {
  static const std::string kNone;
  return failed() ? error_ : kNone;
}

bool AppendFile::push(const Packet& packet) {
  if (failed() || !ring_.push(packet)) return false;
  const std::uint64_t pushed = ring_.pushed();
  if (pushed - called_for_ >= std::min(kFull, ring_.size() / 2)) {
    called_for_ = pushed;
    work_.ring();
  }
  return true;
}

void AppendFile::write(const Packet& packet) {
  flush();
  if (failed()) return;
  ring_.grow(packet_size(packet));
  ring_.push(packet);
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
      if (last) end_compressed();
      release();
    }
    done_.ring();
    if (last) return;
    work_.wait(seen, kLongestDelay);
  }
}

// Nothing is written after an error: a gap in the middle would be worse than a short file. A packet
// stays in the ring until its text is in the file, and the text follows from the ring alone. So a
// crash in the middle of this costs nothing: the handler begins it again, and leaves out what is
// written.
void AppendFile::write_out(Failure failure) {
  PacketPrinter printer(ring_, format_);
  std::uint64_t known = written_;
  while (!failed() && !ring_.empty()) {
    std::string_view text = printer.print(text_);
    const std::uint64_t again = std::min<std::uint64_t>(known, text.size());
    known -= again;
    write_text(text.substr(again), failure);
    if (failed()) return;
    written_ = printer.unfinished_text();
    ring_.take_until(printer.finished());
  }
}

void AppendFile::write_text(std::string_view text, Failure failure) {
  if (text.empty()) return;
  if (frames_) {
    write_compressed(text, failure);
  } else {
    write_plain(text, failure);
  }
}

void AppendFile::write_plain(std::string_view text, Failure failure) {
  while (!failed() && !text.empty()) {
    const std::string_view written = text.substr(0, write_some(text, failure));
    written_ += written.size();
    const auto newline = written.rfind('\n');
    if (newline == std::string_view::npos) {
      unfinished_ += written.size();
    } else {
      unfinished_ = written.size() - newline - 1;
      take_name(failure);
    }
    text.remove_prefix(written.size());
  }
}

// The text is in the file when the whole block is.
void AppendFile::write_compressed(std::string_view text, Failure failure) {
  if (frames_->was_left()) end_frame(failure);
  write_whole(frames_->add(text), failure);
  if (failed()) return;
  if (failure == Failure::Told) frames_->make_room();
  written_ += text.size();
  if (text.find('\n') != std::string_view::npos) take_name(failure);
}

// A compressed file is complete then for any reader of zstd.
void AppendFile::end_frame(Failure failure) {
  if (frames_ && !failed()) write_whole(frames_->end(), failure);
}

void AppendFile::end_compressed() {
  end_frame(Failure::Told);
  if (frames_ && !failed()) write_whole(frames_->table(), Failure::Told);
}

void AppendFile::write_whole(std::string_view bytes, Failure failure) {
  while (!failed() && !bytes.empty()) {
    const std::size_t count = write_some(bytes, failure);
    unfinished_ += count;
    bytes.remove_prefix(count);
  }
  if (!failed()) unfinished_ = 0;
}

// How many bytes: 0 if it was interrupted, or has failed.
std::size_t AppendFile::write_some(std::string_view bytes, Failure failure) {
  const ssize_t count = ::write(file_, bytes.data(), bytes.size());
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN && failure == Failure::Told) {
    if (!await_room()) give_up("write", failure);
  } else if (errno != EINTR) {
    give_up("write", failure);
  }
  return 0;
}

// With the first whole line.
void AppendFile::take_name(Failure failure) {
  if (has_line_) return;
  has_line_ = true;
  if (!out_.take_name()) give_up("replace", failure);
}

void AppendFile::set_patience(Nanoseconds patience) {
  patient_since_ = monotonic_now();
  patience_ = patience;
}

// False: there is no patience left.
bool AppendFile::await_room() {
  constexpr int kLook = 20;  // milliseconds
  const Nanoseconds since = monotonic_now();
  pollfd room{file_, POLLOUT, 0};
  while (poll(&room, 1, kLook) <= 0) {
    const Nanoseconds patience = patience_;
    is_out_of_patience_ = monotonic_now() - std::max(since, patient_since_.load()) >= patience;
    if (is_out_of_patience_) return false;
  }
  return true;
}

void AppendFile::give_up(const char* what, Failure failure) {
  const int reason = errno;
  cut_back();
  errno = reason;
  if (failure == Failure::Told) return fail(what);
  failed_.store(true, std::memory_order_release);
}

// A disk that fills up accepts a part of a line. Counted from the end: somebody may have emptied
// the file meanwhile.
void AppendFile::cut_back() {
  const off_t end = ::lseek(file_, 0, SEEK_END);
  const auto unfinished = static_cast<off_t>(unfinished_);
  // If even that fails, readers know what to do with half a line.
  if (unfinished > 0 && end >= unfinished && ::ftruncate(file_, end - unfinished) == 0) {
    unfinished_ = 0;
  }
}

void AppendFile::fail(const char* what) {
  const std::string reason =
      is_out_of_patience_ ? fmt::format("nobody took anything for {:.2g} s at the end of the run",
                                        to_seconds(patience_.load()))
                          : std::generic_category().message(errno);
  error_ = fmt::format("cannot {} '{}': {}", what, path_, reason);
  failed_.store(true, std::memory_order_release);
}

void AppendFile::emergency_flush() {
  const int before = errno;
  ++emergencies;
  const auto deadline = monotonic_now() + kLongestEmergency;
  for (auto& place : open_files) {
    if (AppendFile* file = place.load()) file->save(deadline);
  }
  --emergencies;
  errno = before;
}

void AppendFile::save(std::chrono::nanoseconds deadline) {
  if (ring_.pushed() == 0) return out_.remove();
  // Later packets, of a tick thread that still runs, are not waited for: it might never end.
  const std::uint64_t until = ring_.pushed();
  const auto is_done = [&] { return failed() || ring_.taken() >= until; };
  // If the crash is in the writing thread, there is nothing to wait for.
  const bool mine = claim_.load() == gettid();
  work_.ring();
  while (!mine && !is_done() && monotonic_now() < deadline) nap();
  if (is_done() || !(mine || claim())) return;
  // An unread pipe must not delay the end of the process.
  ::fcntl(file_, F_SETFL, O_APPEND | O_NONBLOCK);
  write_out(Failure::Silent);
  end_frame(Failure::Silent);
  release();
}

bool AppendFile::claim() {
  pid_t nobody = 0;
  return claim_.compare_exchange_strong(nobody, gettid(), std::memory_order_acquire);
}

void AppendFile::release() {
  claim_.store(0, std::memory_order_release);
}

}  // namespace lockstep::host
