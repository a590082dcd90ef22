#include "language/document/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "base/system/file_descriptor.h"

namespace lockstep::host {
namespace {

tl::unexpected<Problem> failed(int error) {
  return problem(std::generic_category().message(error));
}

Result<void> check_kind(const struct stat& status, FileKinds kinds) {
  if (S_ISREG(status.st_mode)) return {};
  if (S_ISFIFO(status.st_mode) && kinds == FileKinds::RegularOrPipe) return {};
  if (S_ISDIR(status.st_mode)) return failed(EISDIR);
  return problem(kinds == FileKinds::Regular ? "it is not a regular file"
                                             : "it is neither a regular file nor a pipe");
}

Result<std::string> read_all(int file, const struct stat& status, std::size_t limit) {
  std::string text;
  constexpr std::size_t kChunk = 1u << 16u;
  const auto size = std::min(static_cast<std::size_t>(status.st_size), limit);
  const bool is_file = S_ISREG(status.st_mode);
  text.reserve(size + (is_file ? 1 : 2 * kChunk));
  while (text.size() <= limit) {
    const auto before = text.size();
    // To ask for what is there is enough for a file, unless it grows meanwhile.
    const std::size_t chunk = is_file && before <= size ? size - before + 1 : kChunk;
    text.resize(before + chunk);
    const auto count = ::read(file, text.data() + before, chunk);
    const int error = errno;
    text.resize(before + static_cast<std::size_t>(count > 0 ? count : 0));
    if (count == 0) break;
    if (count < 0 && error != EINTR) return failed(error);
  }
  return text;
}

}  // namespace

Result<std::string> read_file(const std::string& path, std::size_t limit, FileKinds kinds) {
  // Looked at before it is opened: to open a device can already do something, or take for ever.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return failed(errno);
  if (const auto kind = check_kind(status, kinds); !kind) return tl::unexpected(kind.error());
  // A regular file may have become a named pipe meanwhile: its writer is not waited for.
  const int blocks = S_ISFIFO(status.st_mode) ? 0 : O_NONBLOCK;
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | blocks));
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) return failed(errno);
  if (const auto kind = check_kind(status, kinds); !kind) return tl::unexpected(kind.error());
  return read_all(file.number(), status, limit);
}

Result<std::string> read_stdin(std::size_t limit) {
  struct stat status {};
  if (::fstat(STDIN_FILENO, &status) != 0) return failed(errno);
  // A socket is what some programs give to their children as a pipe.
  if (!S_ISSOCK(status.st_mode)) {
    const auto kind = check_kind(status, FileKinds::RegularOrPipe);
    if (!kind) return tl::unexpected(kind.error());
  }
  return read_all(STDIN_FILENO, status, limit);
}

}  // namespace lockstep::host
