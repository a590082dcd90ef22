#include "authoring/scaffold/new_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "document/file.h"
#include "system/file_descriptor.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;

Result<void> failed(const fs::path& path) {
  const int error = errno;
  return problem(
      fmt::format("cannot write '{}': {}", path.string(), std::generic_category().message(error)));
}

Result<void> write_all(int file, const std::string& text, const fs::path& path) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) return failed(path);
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  return {};
}

// A file that was not there, and is not there either after a Problem.
Result<void> create(const fs::path& path, const std::string& text, mode_t mode) {
  const FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (file.number() < 0) return failed(path);
  auto written = write_all(file.number(), text, path);
  if (!written) ::unlink(path.c_str());
  return written;
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (!error) return {};
  return problem(fmt::format("cannot make the folder '{}': {}", folder.string(), error.message()));
}

}  // namespace

Result<void> check_free(const NewFiles& files) {
  for (const NewFile& file : files) {
    std::error_code error;
    if (fs::symlink_status(file.path, error).type() == fs::file_type::not_found) continue;
    return problem(fmt::format("'{}' is there already", file.path.string()),
                   "nothing was written; take another name, or move it away");
  }
  return {};
}

Result<void> write_new(const NewFiles& files) {
  if (const auto free = check_free(files); !free) return free;
  for (std::size_t i = 0; i < files.size(); ++i) {
    auto done = make_folder(files[i].path.parent_path());
    if (done) done = create(files[i].path, files[i].text, files[i].is_executable ? 0777 : 0666);
    if (done) continue;
    std::error_code ignored;
    for (std::size_t made = 0; made < i; ++made) fs::remove(files[made].path, ignored);
    return done;
  }
  return {};
}

Result<void> replace_text(const fs::path& path, const std::string& expected,
                          const std::string& text) {
  const fs::path file = fs::weakly_canonical(path);  // a link stays one
  const fs::path beside = file.string() + fmt::format(".{}.new", ::getpid());
  struct stat status {};
  const auto now = read_file(file.string(), kMaxBytes);
  if (!now || *now != expected || ::stat(file.c_str(), &status) != 0) {
    return problem(fmt::format("'{}' has changed meanwhile", path.string()), "try again");
  }
  if (const auto made = create(beside, text, 0600); !made) return made;
  const bool is_named = ::chmod(beside.c_str(), status.st_mode & 07777U) == 0 &&
                        ::rename(beside.c_str(), file.c_str()) == 0;
  if (is_named) return {};
  const auto reason = failed(path);
  ::unlink(beside.c_str());
  return reason;
}

}  // namespace lockstep::host
