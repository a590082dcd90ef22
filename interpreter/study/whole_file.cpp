#include "study/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "system/descriptors.h"

namespace lockstep::host {
namespace {

// A file that is not there yet. 0, or why not.
int write_new(const std::string& path, std::string_view text) {
  const int out = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (out < 0) return errno;
  const int reason = write_all(out, text) ? 0 : errno;
  return close(out) == 0 || reason != 0 ? reason : errno;
}

}  // namespace

Result<void> write_whole_file(const std::string& path, std::string_view text) {
  const std::string fresh = path + ".new";
  unlink(fresh.c_str());  // of a process that was killed, or a link that leads elsewhere
  int reason = write_new(fresh, text);
  if (reason == 0 && rename(fresh.c_str(), path.c_str()) != 0) reason = errno;
  if (reason == 0) return {};
  unlink(fresh.c_str());
  return problem(fmt::format("cannot write '{}': {}", path, std::strerror(reason)));
}

}  // namespace lockstep::host
