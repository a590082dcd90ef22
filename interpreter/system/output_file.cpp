#include "system/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace lockstep::host {
namespace {

constexpr int kFlags = O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY;

std::string reason_text(int reason) {
  return std::generic_category().message(reason);
}

// In the same directory, so that it can take the other's name. Cut, for a name may have 255 bytes.
std::string temporary_name(const std::string& path, int attempt) {
  constexpr std::size_t kLongest = 200;
  const std::size_t name = path.rfind('/') + 1;  // 0 when there is none
  return fmt::format("{}{}.{}-{}.new", path.substr(0, name), path.substr(name, kLongest), getpid(),
                     attempt);
}

bool is_written_as_it_is(mode_t mode) {
  return S_ISFIFO(mode) || S_ISCHR(mode) || S_ISSOCK(mode);
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  struct stat named {
  }, target{};
  const bool is_there = lstat(path_.c_str(), &named) == 0;
  if (path_.empty()) {
    fail(reason_text(ENOENT));
  } else if (stat(path_.c_str(), &target) == 0 && is_written_as_it_is(target.st_mode)) {
    open_as_it_is();
  } else if (is_there && S_ISLNK(named.st_mode)) {
    fail("it is a symbolic link; name the file itself");
  } else if (is_there && !S_ISREG(named.st_mode)) {
    fail(S_ISDIR(named.st_mode) ? reason_text(EISDIR) : "it is neither a file nor a pipe");
  } else {
    open_beside();
  }
}

OutputFile::~OutputFile() {
  remove();
  if (file_ >= 0) close(file_);
}

void OutputFile::open_as_it_is() {
  file_ = open(path_.c_str(), kFlags);
  if (file_ < 0) return fail(reason_text(errno));
  struct stat opened {};
  if (fstat(file_, &opened) == 0 && is_written_as_it_is(opened.st_mode)) return;
  close(std::exchange(file_, -1));
  fail("it was replaced while it was opened");
}

void OutputFile::open_beside() {
  constexpr int kAttempts = 100;  // each name of a process that was killed costs one
  for (int attempt = 0; file_ < 0 && attempt < kAttempts; ++attempt) {
    temporary_ = temporary_name(path_, attempt);
    file_ = open(temporary_.c_str(), kFlags | O_CREAT | O_EXCL, 0666);
    if (file_ < 0 && errno != EEXIST) break;
  }
  if (file_ >= 0) return;
  temporary_.clear();
  fail(reason_text(errno));
}

bool OutputFile::take_name() {
  if (temporary_.empty()) return true;
  if (rename(temporary_.c_str(), path_.c_str()) != 0) return false;
  temporary_.clear();
  return true;
}

void OutputFile::remove() const {
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void OutputFile::fail(const std::string& reason) {
  error_ = fmt::format("cannot open '{}': {}", path_, reason);
}

bool is_same_file(const std::string& a, const std::string& b) {
  struct stat one {
  }, other{};
  if (stat(a.c_str(), &one) != 0 || stat(b.c_str(), &other) != 0) return false;
  return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

}  // namespace lockstep::host
