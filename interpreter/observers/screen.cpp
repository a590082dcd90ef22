#include "observers/screen.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace lockstep {
namespace {

constexpr std::string_view kHideCursor = "\x1b[?25l";
constexpr std::string_view kShowCursor = "\x1b[?25h";
constexpr std::string_view kClearRestOfLine = "\x1b[K";
constexpr std::string_view kClearBelow = "\x1b[J";
constexpr std::string_view kClearAll = "\x1b[H\x1b[2J";

void append_with_cleared_line_ends(std::string& to, std::string_view text) {
  for (const char character : text) {
    if (character == '\n') to += kClearRestOfLine;
    to += character;
  }
}

}  // namespace

void Screen::begin() {
  write(kHideCursor);
}

void Screen::end() {
  write(kShowCursor);
}

void Screen::clear() {
  write(kClearAll);
  lines_ = 0;
}

void Screen::show(std::string_view above, std::string_view frame) {
  std::string text = lines_ == 0 ? "" : fmt::format("\r\x1b[{}A", lines_);
  append_with_cleared_line_ends(text, above);
  append_with_cleared_line_ends(text, frame);
  write(text.append(kClearBelow));
  lines_ = static_cast<std::size_t>(std::count(frame.begin(), frame.end(), '\n'));
}

void Screen::write(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), out_);
  std::fflush(out_);
}

void restore_cursor(int terminal) {
  // In a signal handler there is nobody to tell that it failed.
  [[maybe_unused]] const auto written = ::write(terminal, kShowCursor.data(), kShowCursor.size());
}

}  // namespace lockstep
