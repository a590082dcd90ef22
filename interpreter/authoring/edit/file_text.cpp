#include "authoring/edit/file_text.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "system/output_file.h"

namespace lockstep::host {
namespace {

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const auto written = write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

std::string_view byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.starts_with(kMark) ? kMark : std::string_view();
}

std::optional<Problem> replace_file(const std::string& path, std::string_view text) {
  const auto cannot = [&](int reason) {
    return Problem{
        fmt::format("cannot write '{}': {}", path, std::generic_category().message(reason))};
  };
  std::error_code error;
  const std::string target = std::filesystem::canonical(path, error).string();
  struct stat before {};
  if (error || stat(target.c_str(), &before) != 0) return cannot(error ? error.value() : errno);
  if (access(target.c_str(), W_OK) != 0) return cannot(errno);
  OutputFile file(target);
  if (!file.error().empty()) return Problem{file.error()};
  const bool is_done = fchmod(file.descriptor(), before.st_mode & 07777u) == 0 &&
                       write_all(file.descriptor(), text) && fsync(file.descriptor()) == 0 &&
                       file.take_name();
  return is_done ? std::nullopt : std::optional(cannot(errno));
}

}  // namespace lockstep::host
