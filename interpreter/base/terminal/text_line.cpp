#include "base/terminal/text_line.h"

#include <algorithm>

#include "base/core/diagnostics.h"
#include "base/core/utf8.h"
#include "base/terminal/style.h"

namespace lockstep::host {

void TextLine::add(std::string_view text, Style style) {
  const std::string shown = printable(text);
  const bool styled = color_ && style != Style::Plain;
  if (styled && !is_cut_) text_ += escape(style);
  for (std::string_view rest = shown; !rest.empty() && !is_cut_;) {
    const auto [bytes, code] = first_character(rest);
    const bool as_it_is = unicode_ || bytes == 1;
    const std::size_t needed = as_it_is ? columns(code) : 1;
    if (column_ + needed > width_) return cut();
    marks_ = needed == 0 ? marks_ + 1 : 0;
    if (marks_ <= kMostMarks) text_ += as_it_is ? rest.substr(0, bytes) : "?";
    passed(needed, style);
    rest.remove_prefix(bytes);
  }
  if (styled && !is_cut_) text_ += escape(Style::Plain);
}

void TextLine::fill_to(std::size_t column) {
  while (!is_cut_ && column_ < std::min(column, width_)) {
    text_ += ' ';
    passed(1, Style::Plain);
  }
}

std::string_view TextLine::ellipsis() const {
  return unicode_ ? std::string_view("…") : std::string_view("...").substr(0, width_);
}

void TextLine::passed(std::size_t columns, Style style) {
  column_ += columns;
  const std::size_t needed = unicode_ ? 1 : ellipsis().size();
  if (column_ + needed <= width_) front_ = {text_.size(), column_, style};
}

void TextLine::cut() {
  is_cut_ = true;
  text_.resize(front_.bytes);
  if (width_ > 0) text_ += ellipsis();
  if (color_ && front_.style != Style::Plain) text_ += escape(Style::Plain);
  column_ = width_;
}

}  // namespace lockstep::host
