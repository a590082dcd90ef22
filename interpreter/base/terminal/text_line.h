// One line of a terminal, built from styled pieces. If it is too long for a width, it is cut and
// ends in "…". Counts columns, not bytes; knows nothing about cursors.
#pragma once

#include <string>
#include <string_view>

#include "base/core/style.h"

namespace lockstep::host {

class TextLine {
 public:
  // Without `unicode`, a character that is not ASCII becomes '?', and "…" is "...".
  TextLine(std::size_t width, bool color, bool unicode)
      : width_(width), color_(color), unicode_(unicode) {}

  // Control characters and what is not UTF-8 are made visible.
  void add(std::string_view text, Style style = Style::Plain);
  // Blanks up to a column.
  void fill_to(std::size_t column);

  std::size_t column() const { return column_; }
  const std::string& text() const { return text_; }

 private:
  std::string_view ellipsis() const;
  void passed(std::size_t columns, Style style);
  void cut();

  std::size_t width_;
  bool color_, unicode_;
  std::size_t column_ = 0;
  // On one character; more would make a line that is longer than its columns without end.
  static constexpr std::size_t kMostMarks = 8;
  std::size_t marks_ = 0;  // at its end
  std::string text_;
  // The longest beginning that leaves room for the ellipsis, and the style that it ends in.
  struct Front {
    std::size_t bytes = 0, column = 0;
    Style style = Style::Plain;
  } front_;
  bool is_cut_ = false;
};

}  // namespace lockstep::host
