#include "record/write/growing_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace lockstep::host {
namespace {

// A pipe or a device that has no room says so, instead of waiting.
void make_nonblocking(int file) {
  struct stat status {};
  if (fstat(file, &status) == 0 && !S_ISREG(status.st_mode)) {
    ::fcntl(file, F_SETFL, O_APPEND | O_NONBLOCK);
  }
}

}  // namespace

bool is_written_elsewhere(const std::string& path) {
  constexpr int kFlags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  const FileDescriptor file(open(path.c_str(), kFlags));
  return flock(file.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

GrowingFile::GrowingFile(std::string path, const FileForm& form, Patience& patience)
    : path_(std::move(path)), out_(path_), file_(out_.descriptor()), patience_(patience) {
  if (file_ < 0) {
    error_ = out_.error();
    failed_ = true;
    return;
  }
  if (is_written_elsewhere(path_)) {
    out_.remove();
    fail("open", "another run records to it");
    return;
  }
  flock(file_, LOCK_EX | LOCK_NB);  // where there are no locks, there is no such protection
  make_nonblocking(file_);
  try {
    if (form.encoder) {
      encoder_ = form.encoder();
    } else if (form.compression == Compression::Zstd) {
      frames_.emplace(kText);
    }
  } catch (const std::runtime_error& missing) {  // there is no such library
    fail("write", missing.what());
  }
}

// A process that is just being started has a copy of the file until its program begins: closed
// alone, the lock would last so long.
GrowingFile::~GrowingFile() {
  if (file_ >= 0) flock(file_, LOCK_UN);
}

void GrowingFile::add(std::string_view text, Failure failure, std::uint64_t& written) {
  if (failed_ || text.empty()) return;
  if (!frames_ && !encoder_) return add_plain(text, failure, written);
  if (encoder_) {
    encode([&] { return encoder_->add(text); });
  } else {
    add_compressed(text, failure);
  }
  if (failed_) return;
  written += text.size();
  if (text.find('\n') != std::string_view::npos) take_name(failure);
}

void GrowingFile::pass_time() {
  if (encoder_) encode([this] { return encoder_->add({}); });
}

void GrowingFile::end() {
  if (encoder_) encode([this] { return encoder_->end(); });
  end_frame(Failure::Told);
  if (frames_ && !failed_) write_whole(frames_->table(), Failure::Told);
}

void GrowingFile::end_in_crash() {
  end_frame(Failure::Silent);
}

void GrowingFile::begin_crash() const {
  ::fcntl(file_, F_SETFL, O_APPEND | O_NONBLOCK);
}

void GrowingFile::add_plain(std::string_view text, Failure failure, std::uint64_t& written) {
  while (!failed_ && !text.empty()) {
    const std::string_view some = text.substr(0, write_some(text, failure));
    written += some.size();
    const void* const newline = ::memrchr(some.data(), '\n', some.size());
    if (newline == nullptr) {
      unfinished_ += some.size();
    } else {
      unfinished_ = static_cast<std::size_t>(some.end() - static_cast<const char*>(newline)) - 1;
      take_name(failure);
    }
    text.remove_prefix(some.size());
  }
}

// The text is in the file when the whole block is.
void GrowingFile::add_compressed(std::string_view text, Failure failure) {
  if (frames_->was_left()) end_frame(failure);
  write_whole(frames_->add(text), failure);
  if (!failed_ && failure == Failure::Told) frames_->make_room();
}

template <class Encode>
void GrowingFile::encode(Encode encode) {
  if (failed_) return;
  try {
    write_whole(encode(), Failure::Told);
  } catch (const std::runtime_error& refusal) {
    fail("write", refusal.what());
  }
}

// A compressed file is complete then for any reader of zstd.
void GrowingFile::end_frame(Failure failure) {
  if (frames_ && !failed_) write_whole(frames_->end(), failure);
}

void GrowingFile::write_whole(std::string_view bytes, Failure failure) {
  while (!failed_ && !bytes.empty()) {
    const std::size_t count = write_some(bytes, failure);
    unfinished_ += count;
    bytes.remove_prefix(count);
  }
  if (!failed_) unfinished_ = 0;
}

// How many bytes: 0 if it was interrupted, or has failed.
std::size_t GrowingFile::write_some(std::string_view bytes, Failure failure) {
  const ssize_t count = ::write(file_, bytes.data(), bytes.size());
  if (count >= 0) {
    size_.fetch_add(static_cast<std::uint64_t>(count), std::memory_order_relaxed);
    return static_cast<std::size_t>(count);
  }
  if (errno == EAGAIN && failure == Failure::Told) {
    if (!await_room()) give_up("write", failure);
  } else if (errno != EINTR) {
    give_up("write", failure);
  }
  return 0;
}

// With the first whole line.
void GrowingFile::take_name(Failure failure) {
  if (has_line_) return;
  has_line_ = true;
  if (!out_.take_name()) give_up("replace", failure);
}

// False: there is no patience left.
bool GrowingFile::await_room() {
  constexpr int kLook = 20;  // milliseconds
  const Nanoseconds since = monotonic_now();
  pollfd room{file_, POLLOUT, 0};
  while (poll(&room, 1, kLook) <= 0) {
    const Nanoseconds most = patience_.most;
    patience_.is_over = monotonic_now() - std::max(since, patience_.since.load()) >= most;
    if (patience_.is_over) return false;
  }
  return true;
}

void GrowingFile::give_up(const char* what, Failure failure) {
  const int reason = errno;
  cut_back();
  failed_ = true;
  if (failure == Failure::Silent) return;
  fail(what, patience_.is_over
                 ? fmt::format("no process read anything for {:.2g} s at the end of the run",
                               to_seconds(patience_.most.load()))
                 : std::generic_category().message(reason));
}

// A disk that fills up accepts a part of a line. Counted from the end: somebody may have emptied
// the file meanwhile.
void GrowingFile::cut_back() {
  const off_t end = ::lseek(file_, 0, SEEK_END);
  const auto unfinished = static_cast<off_t>(unfinished_);
  // If even that fails, readers know what to do with half a line.
  if (unfinished > 0 && end >= unfinished && ::ftruncate(file_, end - unfinished) == 0) {
    unfinished_ = 0;
  }
}

void GrowingFile::fail(const char* what, const std::string& reason) {
  failed_ = true;
  error_ = fmt::format("cannot {} '{}': {}", what, path_, reason);
}

}  // namespace lockstep::host
