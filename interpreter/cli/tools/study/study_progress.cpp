#include "cli/tools/study/study_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "base/terminal/outlet.h"
#include "base/terminal/terminal.h"
#include "cli/console.h"
#include "show/view/progress_bar.h"

namespace lockstep::host {
namespace {

constexpr Nanoseconds kBarInterval = std::chrono::milliseconds(200);  // the first comes at once
constexpr Nanoseconds kLineInterval = std::chrono::seconds(10);

std::string duration_text(double seconds) {
  const auto whole = std::llround(seconds);
  if (whole >= 3600)
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

StudyProgress::StudyProgress(const RowSequence& rows)
    : is_terminal_(is_terminal(STDERR_FILENO)),
      rows_(rows),
      before_(rows.count()),
      shown_(is_terminal_ ? start_ - kBarInterval : start_) {}

StudyProgress::~StudyProgress() {
  if (is_visible_) messages().say("\r\x1b[K");
}

void StudyProgress::show() {
  const Nanoseconds now = monotonic_now();
  if (now - shown_ < (is_terminal_ ? kBarInterval : kLineInterval)) return;
  shown_ = now;
  const double seconds = to_seconds(now - start_);
  const std::uint64_t done = rows_.count(), total = rows_.most();
  const double rate = static_cast<double>(done - before_) / seconds;
  const double part = static_cast<double>(done) / static_cast<double>(total);
  const char* const at_most = rows_.is_open() ? "at most " : "";
  std::string text = fmt::format("{} of {}{} runs, {:.0f} %, {:.0f} runs/s", done, at_most, total,
                                 part * 100, rate);
  if (rate > 0) {
    text += fmt::format(", {}{} left", at_most,
                        duration_text(static_cast<double>(total - done) / rate));
  }
  if (!is_terminal_) return messages().say(text + "\n");
  const std::string bar = to_text({.progress = part}, has_unicode());
  is_visible_ |= messages().show(fmt::format("\r{} {}\x1b[K", bar, text));
}

}  // namespace lockstep::host
