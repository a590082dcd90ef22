#include "base/system/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/system/beside.h"
#include "base/system/descriptors.h"

namespace lockstep::host {
namespace {

std::string reason_text(int reason) {
  return std::generic_category().message(reason);
}

bool is_written_as_it_is(mode_t mode) {
  return S_ISFIFO(mode) || S_ISCHR(mode) || S_ISSOCK(mode);
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  struct stat named {
  }, target{};
  const bool is_there = lstat(path_.c_str(), &named) == 0;
  if (path_.empty() || (!is_there && errno == ENAMETOOLONG)) {
    fail(reason_text(path_.empty() ? ENOENT : ENAMETOOLONG));
  } else if (stat(path_.c_str(), &target) == 0 && is_written_as_it_is(target.st_mode)) {
    open_as_it_is();
  } else if (is_there && S_ISLNK(named.st_mode)) {
    fail("it is a symbolic link; name the file itself");
  } else if (is_there && !S_ISREG(named.st_mode)) {
    fail(S_ISDIR(named.st_mode) ? reason_text(EISDIR) : "it is neither a file nor a pipe");
  } else if (is_there && faccessat(AT_FDCWD, path_.c_str(), W_OK, AT_EACCESS) != 0) {
    fail(reason_text(errno));
  } else {
    open_fresh();
  }
}

OutputFile::~OutputFile() {
  remove();
}

void OutputFile::open_as_it_is() {
  file_ = FileDescriptor(open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY));
  if (descriptor() < 0) return fail(reason_text(errno));
  struct stat opened {};
  if (fstat(descriptor(), &opened) == 0 && is_written_as_it_is(opened.st_mode)) return;
  file_ = FileDescriptor();
  fail("it was replaced while it was opened");
}

// Without /proc, it could get no name.
bool OutputFile::open_without_name() {
  const std::string directory = path_.substr(0, path_.rfind('/') + 1);
  file_ = FileDescriptor(open(directory.empty() ? "." : directory.c_str(),
                              O_TMPFILE | O_WRONLY | O_APPEND | O_CLOEXEC, 0666));
  nameless_ = fmt::format("/proc/self/fd/{}", descriptor());
  if (descriptor() >= 0 && access(nameless_.c_str(), F_OK) == 0) return true;
  nameless_.clear();
  return false;
}

void OutputFile::open_fresh() {
  if (open_without_name()) {
    temporary_ = name_beside(path_, 0, ".new");
    return;
  }
  BesideFile fresh = open_beside(path_, ".new", 0666);
  if (fresh.file.number() < 0) return fail(reason_text(errno));
  file_ = std::move(fresh.file);
  temporary_ = std::move(fresh.name);
}

bool OutputFile::take_name() {
  if (!nameless_.empty() && !link_name()) return false;
  if (temporary_.empty()) return true;
  if (!host::take_name(descriptor(), temporary_.c_str(), path_.c_str())) return false;
  temporary_.clear();
  return true;
}

// To its final name, or to the temporary one if there is a file with that name.
bool OutputFile::link_name() {
  const auto link_to = [this](const std::string& name) {
    const bool done =
        linkat(AT_FDCWD, nameless_.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    if (done) nameless_.clear();
    return done;
  };
  if (link_to(path_)) {
    temporary_.clear();
    return true;
  }
  if (errno != EEXIST) return false;
  char& attempt = temporary_[temporary_.size() - 5];  // the digit of "-0.new"
  while (!link_to(temporary_)) {
    if (errno != EEXIST || attempt++ == '9') return false;
  }
  return true;
}

void OutputFile::remove() const {
  if (nameless_.empty() && !temporary_.empty()) unlink(temporary_.c_str());
}

void OutputFile::fail(const std::string& reason) {
  error_ = fmt::format("cannot open '{}': {}", path_, reason);
}

bool take_name(int file, const char* fresh, const char* path) noexcept {
  struct stat old {};
  if (lstat(path, &old) == 0 && S_ISREG(old.st_mode)) keep_properties(path, old, file);
  return rename(fresh, path) == 0;
}

Result<void> write_output(const std::string& path, std::string_view text) {
  OutputFile file(path);
  if (!file.error().empty()) return problem(file.error());
  if (write_all(file.descriptor(), text) && file.take_name()) return {};
  return problem(fmt::format("cannot write '{}': {}", path, reason_text(errno)));
}

bool is_same_file(const std::string& a, const std::string& b) {
  struct stat one {
  }, other{};
  if (stat(a.c_str(), &one) != 0 || stat(b.c_str(), &other) != 0) return false;
  return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

}  // namespace lockstep::host
