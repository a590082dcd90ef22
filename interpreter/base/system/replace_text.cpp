#include "base/system/replace_text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "base/system/beside.h"
#include "base/system/descriptors.h"
#include "base/system/mutex.h"

namespace lockstep::host {
namespace {

tl::unexpected<Problem> cannot_write(const std::string& path, int reason, std::string hint = {}) {
  return problem(
      fmt::format("cannot write '{}': {}", path, std::generic_category().message(reason)),
      std::move(hint));
}

FileDescriptor open_text(const std::string& path, int flags) {
  return FileDescriptor(open(path.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
}

bool has_text(int file, std::string_view text) {
  struct stat status {};
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return false;
  std::array<char, 1u << 16> block;
  std::size_t at = 0;
  while (true) {
    const ssize_t count = pread(file, block.data(), block.size(), static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count == 0 && at == text.size();
    const std::string_view some(block.data(), static_cast<std::size_t>(count));
    if (!text.substr(at).starts_with(some)) return false;
    at += some.size();
  }
}

bool has_text(const std::string& path, std::string_view text) {
  const FileDescriptor file = open_text(path, O_RDONLY);
  return file.number() >= 0 && has_text(file.number(), text);
}

// All of the file, from its beginning.
bool overwrite(int file, std::string_view text) {
  return lseek(file, 0, SEEK_SET) == 0 && write_all(file, text) &&
         ftruncate(file, static_cast<off_t>(text.size())) == 0 && fsync(file) == 0;
}

// Whoever writes to a file takes the rights from it that its owner gives to others with it
// (S_ISUID, S_ISGID). The system may refuse to give them back.
void restore_mode(int file, mode_t mode) {
  struct stat now {};
  if (fstat(file, &now) == 0 && now.st_mode != mode) fchmod(file, mode & 07777u);
}

// A signal that would end the process does so when this ends, whichever thread it comes to.
class LaterEnd {
 public:
  LaterEnd() {
    struct sigaction later {};
    later.sa_handler = [](int number) { g_came[place_of(number)] = true; };
    later.sa_flags = SA_RESTART;
    for (const int number : kSignals) {
      struct sigaction& before = before_[place_of(number)];
      sigaction(number, nullptr, &before);
      if (before.sa_handler == SIG_DFL) sigaction(number, &later, nullptr);
    }
  }
  ~LaterEnd() {
    for (const int number : kSignals) {
      const struct sigaction& before = before_[place_of(number)];
      if (before.sa_handler != SIG_DFL) continue;
      sigaction(number, &before, nullptr);
      if (g_came[place_of(number)].exchange(false)) kill(getpid(), number);
    }
  }
  LaterEnd(const LaterEnd&) = delete;
  LaterEnd& operator=(const LaterEnd&) = delete;

 private:
  static constexpr std::array kSignals = {SIGINT, SIGQUIT, SIGTERM, SIGHUP};
  static std::size_t place_of(int number) {
    return static_cast<std::size_t>(std::ranges::find(kSignals, number) - kSignals.begin());
  }

  static inline Mutex g_one_at_a_time;
  static inline std::array<std::atomic<bool>, kSignals.size()> g_came;

  const Lock lock_{g_one_at_a_time};
  std::array<struct sigaction, kSignals.size()> before_{};
};

class Replacement {
 public:
  Replacement(const std::string& path, std::string_view expected, std::string_view text)
      : path_(path), expected_(expected), text_(text) {}

  Result<void> run() {
    std::error_code error;
    target_ = std::filesystem::canonical(path_, error).string();
    if (error) return error.value() == ENOENT ? changed() : cannot_write(path_, error.value());
    const FileDescriptor old = open_text(target_, O_RDONLY);
    struct stat status {};
    if (old.number() < 0 || fstat(old.number(), &status) != 0) return cannot_write(path_, errno);
    if (!has_text(old.number(), expected_)) return changed();
    if (faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0)
      return cannot_write(path_, errno);
    mode_ = status.st_mode;
    if (status.st_nlink > 1) return in_place();
    const BesideFile fresh = open_beside(target_, ".new", 0600);
    if (fresh.file.number() < 0) {
      const bool is_refused = errno == EACCES || errno == EPERM || errno == EROFS;
      return is_refused ? in_place() : cannot_write(path_, errno);
    }
    const int file = fresh.file.number();
    if (keep_properties(target_.c_str(), status, file) != Kept::All) {
      unlink(fresh.name.c_str());
      return in_place();
    }
    if (write_all(file, text_) && fsync(file) == 0) {
      restore_mode(file, mode_);
      return exchange(fresh.name);
    }
    const int reason = errno;
    unlink(fresh.name.c_str());
    return cannot_write(path_, reason);
  }

 private:
  Result<void> changed() const {
    return problem(fmt::format("'{}' has changed meanwhile", path_),
                   "it has the text that was saved last; try again");
  }

  // The file beside it takes the name.
  Result<void> exchange(const std::string& fresh) const {
    if (swap_names(fresh)) {
      if (has_text(fresh, expected_)) {
        unlink(fresh.c_str());
        return {};
      }
      if (!swap_names(fresh) || !has_text(fresh, text_)) {
        return problem(fmt::format("'{}' has changed meanwhile", path_),
                       fmt::format("a text that was saved is in '{}'", fresh));
      }
      unlink(fresh.c_str());
      return changed();
    }
    const int reason = errno;
    // Not on each file system.
    const bool is_as_read = has_text(target_, expected_);
    const bool can_only_rename = reason == EINVAL || reason == ENOSYS || reason == EOPNOTSUPP;
    if (is_as_read && can_only_rename && rename(fresh.c_str(), target_.c_str()) == 0) return {};
    const int last = can_only_rename ? errno : reason;
    unlink(fresh.c_str());
    if (!is_as_read) return changed();
    return last == EACCES || last == EPERM ? in_place() : cannot_write(path_, last);
  }

  bool swap_names(const std::string& fresh) const {
    return renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0;
  }

  Result<void> in_place() const {
    const FileDescriptor file = open_text(target_, O_RDWR);
    if (file.number() < 0) return cannot_write(path_, errno);
    const BesideFile copy = open_beside(target_, ".old", 0600);
    const auto end = [&](Result<void> result) {
      restore_mode(file.number(), mode_);
      if (copy.file.number() >= 0) unlink(copy.name.c_str());
      return result;
    };
    if (copy.file.number() >= 0 &&
        (!write_all(copy.file.number(), expected_) || fsync(copy.file.number()) != 0))
      return end(cannot_write(path_, errno));
    const bool is_reserved =
        fallocate(file.number(), FALLOC_FL_KEEP_SIZE, 0,
                  static_cast<off_t>(std::max<std::size_t>(text_.size(), 1))) == 0 ||
        errno == EOPNOTSUPP || errno == ENOSYS;
    if (!is_reserved) return end(cannot_write(path_, errno));
    if (!has_text(file.number(), expected_)) return end(changed());
    if (overwrite(file.number(), text_)) return end({});
    const int reason = errno;
    if (overwrite(file.number(), expected_) || copy.file.number() < 0)
      return end(cannot_write(path_, reason));
    return cannot_write(path_, reason, fmt::format("its text is in '{}'", copy.name));
  }

  const std::string& path_;
  const std::string_view expected_, text_;
  std::string target_;  // without links
  mode_t mode_ = 0;
};

}  // namespace

Result<void> replace_text(const std::string& path, std::string_view expected,
                          std::string_view text) {
  const LaterEnd complete;
  return Replacement(path, expected, text).run();
}

Result<void> create_text(const std::string& path, std::string_view text, mode_t mode) {
  const FileDescriptor file(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (file.number() < 0) return cannot_write(path, errno);
  if (write_all(file.number(), text)) return {};
  const int reason = errno;
  unlink(path.c_str());
  return cannot_write(path, reason);
}

}  // namespace lockstep::host
