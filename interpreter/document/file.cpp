#include "document/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace lockstep {
namespace {

FileText failed(int error) {
  return {{}, std::generic_category().message(error)};
}

class OpenFile {
 public:
  // Not blocking, for what is a named pipe by now.
  explicit OpenFile(const std::string& path)
      : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK)) {}
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
std::string check_regular(const struct stat& status) {
  if (S_ISREG(status.st_mode)) return {};
  if (S_ISDIR(status.st_mode)) return failed(EISDIR).failure;
  return "it is not a regular file";
}

}  // namespace

FileText read_file(const std::string& path, std::size_t limit) {
  // Looked at before it is opened: to open a device can already do something, or take for ever.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return failed(errno);
  if (auto failure = check_regular(status); !failure.empty()) return {{}, std::move(failure)};
  const OpenFile file(path);
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) return failed(errno);
  if (auto failure = check_regular(status); !failure.empty()) return {{}, std::move(failure)};

  FileText result;
  constexpr std::size_t kChunk = 1u << 16u;
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size <= limit) result.text.reserve(size + kChunk);
  while (result.text.size() <= limit) {
    const auto before = result.text.size();
    result.text.resize(before + kChunk);
    const auto count = ::read(file.number(), result.text.data() + before, kChunk);
    const int error = errno;
    result.text.resize(before + static_cast<std::size_t>(count > 0 ? count : 0));
    if (count == 0) break;
    if (count < 0 && error != EINTR) return failed(error);
  }
  return result;
}

}  // namespace lockstep
