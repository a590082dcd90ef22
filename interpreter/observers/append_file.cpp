#include "observers/append_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "observers/quiet_thread.h"

namespace lockstep {

AppendFile::AppendFile(const std::string& path) : path_(path) {
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) {
    fail("open");
    return;
  }
  buffer_.reserve(2 * kFull);
  pending_.reserve(2 * kFull);
  thread_ = quiet_thread([this] { write_until_stopped(); });
}

AppendFile::~AppendFile() {
  if (file_ < 0) return;
  flush();
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  work_.notify_one();
  thread_.join();
  ::close(file_);
}

const std::string& AppendFile::error() const {
  static const std::string kNone;
  return failed_.load(std::memory_order_acquire) ? error_ : kNone;
}

void AppendFile::line_done() {
  if (!error().empty()) return buffer_.clear();
  const auto now = std::chrono::steady_clock::now();
  if (buffer_.size() < kFull && now - handed_over_ < kLongestDelay) return;
  std::unique_lock lock(mutex_, std::defer_lock);
  if (buffer_.size() >= kMost) {
    lock.lock();
    done_.wait(lock, [this] { return pending_.size() == 0; });
  }
  // A busy disk gets it with one of the next lines.
  if (!lock.owns_lock() && !lock.try_lock()) return;
  if (pending_.size() == 0) hand_over(lock);
}

void AppendFile::flush() {
  if (!error().empty()) return buffer_.clear();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return pending_.size() == 0; });
  hand_over(lock);
  lock.lock();
  done_.wait(lock, [this] { return pending_.size() == 0 && !writing_; });
}

void AppendFile::hand_over(std::unique_lock<std::mutex>& lock) {
  std::swap(buffer_, pending_);
  lock.unlock();
  work_.notify_one();
  handed_over_ = std::chrono::steady_clock::now();
}

void AppendFile::write_until_stopped() {
  fmt::memory_buffer text;
  text.reserve(2 * kFull);
  std::unique_lock lock(mutex_);
  while (true) {
    work_.wait(lock, [this] { return stopping_ || pending_.size() != 0; });
    if (pending_.size() == 0) return;
    std::swap(text, pending_);
    writing_ = true;
    lock.unlock();
    write(text);
    text.clear();
    lock.lock();
    writing_ = false;
    done_.notify_all();
  }
}

// Nothing is written after an error: a gap in the middle would be worse than a short file.
void AppendFile::write(const fmt::memory_buffer& text) {
  const char* from = text.data();
  const char* const end = from + text.size();
  while (from != end && error().empty()) {
    const ssize_t written = ::write(file_, from, static_cast<std::size_t>(end - from));
    if (written >= 0) {
      from += written;
    } else if (errno != EINTR) {
      fail("write");
    }
  }
}

void AppendFile::fail(const char* what) {
  const std::string reason = std::generic_category().message(errno);
  error_ = fmt::format("cannot {} '{}': {}", what, path_, reason);
  failed_.store(true, std::memory_order_release);
}

}  // namespace lockstep
