#include "cli/run/view.h"

#include <fmt/format.h>
#include <unistd.h>

#include "base/core/clock.h"
#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/terminal/terminal.h"
#include "cli/console.h"

namespace lockstep::host {

View::View(const std::string& mode, const Shape& shape, lockstep_log_level least) : least_(least) {
  const bool wants_live = mode == "live" || (mode == "auto" && is_terminal(STDERR_FILENO));
  if (wants_live && can_draw()) {
    const bool has_keys = is_terminal(STDIN_FILENO) && is_terminal(STDERR_FILENO);
    live_.emplace(shape, LiveOptions{.keys = has_keys ? STDIN_FILENO : -1,
                                     .color = wants_color(STDERR_FILENO),
                                     .unicode = has_unicode()});
  } else if (mode != "none") {
    plain_.emplace(shape);
  }
}

Observer* View::observer() {
  if (live_) return &*live_;
  return plain_ ? &*plain_ : nullptr;
}

void View::continue_with(std::uint64_t tick, Nanoseconds time) {
  if (plain_) plain_->continue_with(tick, time);
}

void View::print(const std::string& line) {
  if (live_) {
    live_->print(line);
  } else if (plain_) {
    plain_->print(line);
  } else {
    messages().say(printable(line) + "\n");
  }
}

LeafLog View::leaf_log() {
  return [this](std::string_view who, lockstep_log_level level, std::string_view message) {
    if (level < least_) return;
    log(fmt::format("{}: {}: {}", printable(who), name_of(level), printable(message)));
  };
}

void View::log(const std::string& line) {
  std::uint64_t left_out = 0;
  {
    const Lock lock(mutex_);
    if (!budget_.take(monotonic_now())) return;
    left_out = budget_.take_left_out();
  }
  print_left_out(left_out);
  print(line);
}

void View::print_left_out(std::uint64_t lines) {
  if (lines > 0) print(fmt::format("... {} of leaves left out", counted(lines, "line")));
}

void View::close() {
  live_.reset();
  const Lock lock(mutex_);
  print_left_out(budget_.take_left_out());
}

void View::last_words() {
  RawTerminal::restore_for_good();
}

}  // namespace lockstep::host
