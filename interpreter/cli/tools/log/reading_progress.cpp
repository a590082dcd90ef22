#include "cli/tools/log/reading_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/terminal/outlet.h"
#include "base/terminal/terminal.h"
#include "cli/console.h"
#include "show/view/progress_bar.h"

namespace lockstep::host {
namespace {

constexpr Nanoseconds kQuietTime = std::chrono::milliseconds(500);
constexpr Nanoseconds kRefreshTime = std::chrono::milliseconds(200);

}  // namespace

ReadingProgress::ReadingProgress(const std::string& path)
    : is_terminal_(is_terminal(STDERR_FILENO)), next_(monotonic_now() + kQuietTime) {
  std::error_code error;
  if (path != "-" && std::filesystem::is_regular_file(path, error)) {
    const auto size = std::filesystem::file_size(path, error);
    if (!error) all_ = size;
  }
}

ReadingProgress::~ReadingProgress() {
  if (is_visible_) messages().say("\r\x1b[K");
}

void ReadingProgress::add(std::uint64_t bytes) {
  read_ += bytes;
  if (!is_terminal_) return;
  const Nanoseconds now = monotonic_now();
  if (now < next_) return;
  next_ = now + kRefreshTime;
  is_visible_ |= messages().show(fmt::format("\r{}\x1b[K", text()));
}

std::string ReadingProgress::text() const {
  constexpr double kMegabyte = 1e6;
  const double read = static_cast<double>(read_), all = static_cast<double>(all_);
  if (all_ == 0) return fmt::format("{:.0f} MB", read / kMegabyte);
  const double part = std::min(read / all, 1.0);  // the file may grow
  return fmt::format("{} {:.0f} %, {:.0f} of {:.0f} MB", to_text({.progress = part}, has_unicode()),
                     part * 100, read / kMegabyte, all / kMegabyte);
}

}  // namespace lockstep::host
