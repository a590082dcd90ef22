#include "document/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace lockstep {
namespace {

FileText failed(int error) {
  return {{}, std::generic_category().message(error)};
}

class OpenFile {
 public:
  explicit OpenFile(int number) : number_(number) {}
  ~OpenFile() {
    if (number_ >= 0) ::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

// "" or what else it is.
std::string check_kind(const struct stat& status, FileKinds kinds) {
  if (S_ISREG(status.st_mode)) return {};
  if (S_ISFIFO(status.st_mode) && kinds == FileKinds::RegularOrPipe) return {};
  if (S_ISDIR(status.st_mode)) return failed(EISDIR).failure;
  return kinds == FileKinds::Regular ? "it is not a regular file"
                                     : "it is neither a regular file nor a pipe";
}

FileText read_all(int file, const struct stat& status, std::size_t limit) {
  FileText result;
  constexpr std::size_t kChunk = 1u << 16u;
  const auto size = static_cast<std::size_t>(status.st_size);
  result.text.reserve(std::min(size, limit) + 2 * kChunk);
  while (result.text.size() <= limit) {
    const auto before = result.text.size();
    result.text.resize(before + kChunk);
    const auto count = ::read(file, result.text.data() + before, kChunk);
    const int error = errno;
    result.text.resize(before + static_cast<std::size_t>(count > 0 ? count : 0));
    if (count == 0) break;
    if (count < 0 && error != EINTR) return failed(error);
  }
  return result;
}

}  // namespace

FileText read_file(const std::string& path, std::size_t limit, FileKinds kinds) {
  // Looked at before it is opened: to open a device can already do something, or take for ever.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return failed(errno);
  if (auto failure = check_kind(status, kinds); !failure.empty()) return {{}, std::move(failure)};
  // What is a regular file may be a named pipe by now: then its writer is not waited for.
  const int blocks = S_ISFIFO(status.st_mode) ? 0 : O_NONBLOCK;
  const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | blocks));
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) return failed(errno);
  if (auto failure = check_kind(status, kinds); !failure.empty()) return {{}, std::move(failure)};
  return read_all(file.number(), status, limit);
}

FileText read_stdin(std::size_t limit) {
  struct stat status {};
  if (::fstat(STDIN_FILENO, &status) != 0) return failed(errno);
  // A socket is what some programs give to their children as a pipe.
  auto failure =
      S_ISSOCK(status.st_mode) ? std::string() : check_kind(status, FileKinds::RegularOrPipe);
  if (!failure.empty()) return {{}, std::move(failure)};
  return read_all(STDIN_FILENO, status, limit);
}

}  // namespace lockstep
