#include "language/document/cursor.h"

#include <algorithm>
#include <iterator>

#include "base/core/utf8.h"

namespace lockstep::host {
namespace {

struct Block {
  char32_t first, last;
};

// NameStartChar of XML 1.0, fifth edition.
constexpr Block kStarts[] = {
    {':', ':'},       {'A', 'Z'},       {'_', '_'},       {'a', 'z'},
    {0xC0, 0xD6},     {0xD8, 0xF6},     {0xF8, 0x2FF},    {0x370, 0x37D},
    {0x37F, 0x1FFF},  {0x200C, 0x200D}, {0x2070, 0x218F}, {0x2C00, 0x2FEF},
    {0x3001, 0xD7FF}, {0xF900, 0xFDCF}, {0xFDF0, 0xFFFD}, {0x10000, 0xEFFFF}};
// NameChar has these besides.
constexpr Block kParts[] = {{'-', '.'}, {'0', '9'}, {0xB7, 0xB7}, {0x300, 0x36F}, {0x203F, 0x2040}};

template <std::size_t Count>
bool is_in(const Block (&blocks)[Count], char32_t code) {
  return std::any_of(std::begin(blocks), std::end(blocks),
                     [code](Block block) { return code >= block.first && code <= block.last; });
}

}  // namespace

std::size_t xml_name_length(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size()) {
    const auto [bytes, code] = first_character(text.substr(length));
    if (bytes == 0) break;
    if (!is_in(kStarts, code) && (length == 0 || !is_in(kParts, code))) break;
    length += bytes;
  }
  return length;
}

std::optional<std::string_view> Cursor::take_quoted() {
  if (position_ == text_.size()) return std::nullopt;
  const char quote = text_[position_];
  if (quote != '"' && quote != '\'') return std::nullopt;
  const auto end = text_.find(quote, position_ + 1);
  if (end == std::string_view::npos) return std::nullopt;
  const auto inside = text_.substr(position_ + 1, end - position_ - 1);
  position_ = end + 1;
  return inside;
}

}  // namespace lockstep::host
