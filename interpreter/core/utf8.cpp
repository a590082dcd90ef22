#include "core/utf8.h"

#include <algorithm>
#include <iterator>

namespace lockstep {
namespace {

constexpr bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
}

// The second byte of these leads is narrower than 80..BF: overlong forms, surrogates, the end.
constexpr bool is_second(unsigned char lead, char c) {
  const auto byte = static_cast<unsigned char>(c);
  switch (lead) {
    case 0xE0:
      return byte >= 0xA0 && byte <= 0xBF;
    case 0xED:
      return byte >= 0x80 && byte <= 0x9F;
    case 0xF0:
      return byte >= 0x90 && byte <= 0xBF;
    case 0xF4:
      return byte >= 0x80 && byte <= 0x8F;
    default:
      return is_continuation(c);
  }
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return 1;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (text.size() < length || !is_second(lead, text[1])) return 0;
  for (std::size_t i = 2; i < length; ++i)
    if (!is_continuation(text[i])) return 0;
  return length;
}

std::string_view utf8_front(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  auto length = bytes;
  for (int step = 0; step < 3 && length > 0 && is_continuation(text[length]); ++step) --length;
  return text.substr(0, length);
}

char32_t code_point(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  char32_t code = first < 0x80 ? first : first & (0x7Fu >> character.size());
  for (const char next : character.substr(1)) {
    code = code << 6u | (static_cast<unsigned char>(next) & 0x3Fu);
  }
  return code;
}

bool is_obeyed_by_terminals(char32_t code) {
  constexpr struct {
    char32_t first, last;
  } kObeyed[] = {{0x00, 0x1F},     {0x7F, 0x9F},     {0x61C, 0x61C},
                 {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x2069}};
  return std::any_of(std::begin(kObeyed), std::end(kObeyed),
                     [code](auto block) { return code >= block.first && code <= block.last; });
}

}  // namespace lockstep
