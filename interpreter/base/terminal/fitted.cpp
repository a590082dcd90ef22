#include "base/terminal/fitted.h"

#include <algorithm>

#include "base/core/utf8.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kHanging = 4;  // columns

// Without the sequences that color it.
std::size_t shown_columns(std::string_view text) {
  std::size_t sum = 0;
  for (;;) {
    const std::size_t plain = std::min(text.find('\x1b'), text.size());
    sum += columns(text.substr(0, plain));
    const std::size_t end = text.find('m', plain);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return sum;
}

// A word with the blanks before it.
std::string_view take_word(std::string_view& line) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::string_view word = line.substr(0, std::min(line.find(' ', begin), line.size()));
  line.remove_prefix(word.size());
  return word;
}

void append_line(std::string_view line, std::size_t width, std::string& out) {
  if (shown_columns(line) <= width) {
    out += line;
    return;
  }
  const std::size_t indent = std::min(line.find_first_not_of(' ') + kHanging, width / 2);
  std::size_t used = 0;
  while (!line.empty()) {
    std::string_view word = take_word(line);
    if (used > 0 && used + shown_columns(word) > width) {
      word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
      out.append("\n").append(indent, ' ');
      used = indent;
    }
    out += word;
    used += shown_columns(word);
  }
}

}  // namespace

std::string fitted(std::string_view text, std::size_t width) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    append_line(text.substr(0, end), width, out);
    if (end < text.size()) out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

}  // namespace lockstep::host
