#include "base/system/lock_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace lockstep::host {
namespace {

// Whoever had it before may have removed it since it was opened.
bool has_name(int file, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

LockFile::LockFile(std::string path) : path_(std::move(path)) {
  constexpr int kFlags = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  constexpr int kAttempts = 100;
  for (int attempt = 0; attempt < kAttempts && file_.number() < 0; ++attempt) {
    FileDescriptor file(open(path_.c_str(), kFlags, 0666));
    if (file.number() < 0) return;
    if (flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
      is_elsewhere_ = errno == EWOULDBLOCK;
      return;
    }
    if (has_name(file.number(), path_)) file_ = std::move(file);
  }
}

LockFile::~LockFile() {
  if (file_.number() >= 0) unlink(path_.c_str());
}

}  // namespace lockstep::host
