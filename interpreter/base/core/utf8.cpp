#include "base/core/utf8.h"

#include <utf8proc.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace lockstep::host {
namespace {

constexpr bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
}

}  // namespace

Character first_character(std::string_view text) {
  if (text.empty()) return {};
  if (const char c = text.front(); static_cast<unsigned char>(c) < 0x80) {
    return {1, static_cast<char32_t>(c)};
  }
  utf8proc_int32_t code = 0;
  const auto bytes =
      utf8proc_iterate(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                       static_cast<utf8proc_ssize_t>(std::min<std::size_t>(text.size(), 4)), &code);
  if (bytes <= 0) return {};
  return {static_cast<std::size_t>(bytes), static_cast<char32_t>(code)};
}

bool is_utf8(std::string_view text) {
  constexpr std::uint64_t kHighBits = 0x8080808080808080u;
  while (!text.empty()) {
    std::uint64_t block = kHighBits;
    if (text.size() >= sizeof block) std::memcpy(&block, text.data(), sizeof block);
    const std::size_t bytes = (block & kHighBits) == 0 ? sizeof block : utf8_length(text);
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

std::string_view utf8_front(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  auto length = bytes;
  for (int step = 0; step < 3 && length > 0 && is_continuation(text[length]); ++step) --length;
  return text.substr(0, length);
}

std::size_t columns(char32_t code) {
  return static_cast<std::size_t>(utf8proc_charwidth(static_cast<utf8proc_int32_t>(code)));
}

std::size_t columns(std::string_view text) {
  std::size_t sum = 0;
  while (!text.empty()) {
    const auto [bytes, code] = first_character(text);
    sum += bytes == 0 ? 1 : columns(code);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return sum;
}

bool is_obeyed_by_terminals(char32_t code) {
  constexpr struct {
    char32_t first, last;
  } kObeyed[] = {{0x00, 0x1F},     {0x7F, 0x9F},     {0x61C, 0x61C},
                 {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x2069}};
  return std::any_of(std::begin(kObeyed), std::end(kObeyed),
                     [code](auto block) { return code >= block.first && code <= block.last; });
}

}  // namespace lockstep::host
