#include "base/terminal/screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/system/descriptors.h"

namespace lockstep::host {
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

void Screen::clear() {
  out_.say(kClearAll);
  lines_ = 0;
}

bool Screen::show(std::string_view above, std::string_view frame) {
  std::string text = lines_ == 0 ? "" : fmt::format("\r\x1b[{}A", lines_);
  append_with_cleared_line_ends(text, above);
  append_with_cleared_line_ends(text, frame);
  if (!out_.show(text.append(kClearBelow))) return false;
  lines_ = static_cast<std::size_t>(std::count(frame.begin(), frame.end(), '\n'));
  return true;
}

void hide_cursor(int terminal) {
  write_now(terminal, kHideCursor);
}

void show_cursor(int terminal) {
  write_now(terminal, kShowCursor);
}

}  // namespace lockstep::host
