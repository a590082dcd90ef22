#include "terminal/text_line.h"

#include <algorithm>

#include "core/diagnostics.h"

namespace lockstep {
namespace {

struct Character {
  std::string_view bytes;
  std::size_t columns;
};

// The blocks of wide characters: Chinese, Japanese, Korean, emoji.
bool is_wide(char32_t code) {
  constexpr struct {
    char32_t first, last;
  } kWide[] = {{0x1100, 0x115f}, {0x2e80, 0xa4cf}, {0xac00, 0xd7a3},   {0xf900, 0xfaff},
               {0xfe30, 0xfe6f}, {0xff00, 0xff60}, {0x1f300, 0x1faff}, {0x20000, 0x3fffd}};
  return std::any_of(std::begin(kWide), std::end(kWide),
                     [code](auto block) { return code >= block.first && code <= block.last; });
}

// Takes the first character off valid UTF-8.
Character take_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t size = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  const auto bytes = text.substr(0, size);
  text.remove_prefix(bytes.size());
  char32_t code = first < 0x80 ? first : first & (0x7fu >> size);
  for (const char next : bytes.substr(1))
    code = code << 6 | (static_cast<unsigned char>(next) & 63);
  return {bytes, is_wide(code) ? 2u : 1u};
}

}  // namespace

void TextLine::add(std::string_view text, Style style) {
  const std::string shown = printable(text);
  const bool styled = color_ && style != Style::Plain;
  if (styled && !is_cut_) text_ += escape(style);
  for (std::string_view rest = shown; !rest.empty() && !is_cut_;) {
    const Character character = take_character(rest);
    const bool ascii = unicode_ || character.bytes.size() == 1;
    const std::size_t needed = ascii ? character.columns : 1;
    if (column_ + needed > width_) return cut();
    text_ += ascii ? character.bytes : std::string_view("?");
    passed(needed, style);
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

std::size_t columns(std::string_view text) {
  const std::string shown = printable(text);
  std::size_t sum = 0;
  for (std::string_view rest = shown; !rest.empty();) sum += take_character(rest).columns;
  return sum;
}

}  // namespace lockstep
