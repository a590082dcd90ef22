// UTF-8 with utf8proc: characters, and how a terminal shows them.
#pragma once

#include <cstddef>
#include <string_view>

namespace lockstep::host {

struct Character {
  std::size_t bytes = 0;  // 1 to 4
  char32_t code = 0;
};

// The first character of `text`. 0 bytes if there is none: `text` is empty, or begins with a stray
// or cut sequence, an overlong form, a surrogate, or a code point beyond U+10FFFF.
Character first_character(std::string_view text);
inline std::size_t utf8_length(std::string_view text) {
  return first_character(text).bytes;
}

// Whether it has nothing but such characters.
bool is_utf8(std::string_view text);

// The longest front part of `text` that has at most `bytes` bytes and does not cut a character.
std::string_view utf8_front(std::string_view text, std::size_t bytes);

// How many columns a terminal needs: 2 for a wide character, 0 for a mark on the one before it.
std::size_t columns(char32_t code);
// The sum over a text that is printable().
std::size_t columns(std::string_view text);

// Characters that control a terminal: control characters (some terminals also obey U+0080 to
// U+009F), line ends, and marks that reverse the direction of the following text.
bool is_obeyed_by_terminals(char32_t code);

}  // namespace lockstep::host
