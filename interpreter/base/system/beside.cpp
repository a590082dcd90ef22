#include "base/system/beside.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>

namespace lockstep::host {
namespace {

// Others say what is in a file, as a signature does, or what a program may do.
bool is_kept(std::string_view attribute) {
  return attribute == "system.posix_acl_access" || attribute == "security.selinux" ||
         attribute.starts_with("user.");
}

// What is larger than these buffers is left out: a crash handler has no more stack.
void keep_attributes(const char* path, int file) {
  std::array<char, 1024> names;
  std::array<char, 2048> value;
  const ssize_t length = listxattr(path, names.data(), names.size());
  for (ssize_t at = 0; at < length;) {
    const std::string_view name = &names[static_cast<std::size_t>(at)];
    at += static_cast<ssize_t>(name.size()) + 1;
    if (!is_kept(name)) continue;
    const ssize_t bytes = getxattr(path, name.data(), value.data(), value.size());
    if (bytes >= 0) fsetxattr(file, name.data(), value.data(), static_cast<std::size_t>(bytes), 0);
  }
}

}  // namespace

// Cut, for a name may have 255 bytes.
std::string name_beside(const std::string& path, int attempt, const char* ending) {
  constexpr std::size_t kLongest = 200;
  const std::size_t name = path.rfind('/') + 1;  // 0 when there is none
  return fmt::format("{}{}.{}-{}{}", path.substr(0, name), path.substr(name, kLongest), getpid(),
                     attempt, ending);
}

BesideFile open_beside(const std::string& path, const char* ending, mode_t mode) {
  constexpr int kAttempts = 100;  // each name of a process that was killed costs one
  constexpr int kFlags = O_WRONLY | O_APPEND | O_CREAT | O_EXCL | O_CLOEXEC | O_NOCTTY;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    std::string name = name_beside(path, attempt, ending);
    FileDescriptor file(open(name.c_str(), kFlags, mode));
    if (file.number() >= 0) return {std::move(file), std::move(name)};
    if (errno != EEXIST) break;
  }
  return {.file = FileDescriptor(), .name = {}};
}

Kept keep_properties(const char* path, const struct stat& old, int file) noexcept {
  struct stat fresh {};
  if (fstat(file, &fresh) != 0) return Kept::NotTheOwner;
  const bool is_owned = (fresh.st_uid == old.st_uid && fresh.st_gid == old.st_gid) ||
                        fchown(file, old.st_uid, old.st_gid) == 0;
  fchmod(file, old.st_mode & (is_owned ? 0777u : fresh.st_mode & 0777u));
  if (!is_owned) return Kept::NotTheOwner;
  keep_attributes(path, file);
  return Kept::All;
}

}  // namespace lockstep::host
