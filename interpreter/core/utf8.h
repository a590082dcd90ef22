// Reading UTF-8 byte by byte: just enough to refuse what is not, and to count what a terminal
// shows, or obeys. Used by the renderer of diagnostics and by the reader of documents.
#pragma once

#include <cstddef>
#include <string_view>

namespace lockstep {

// The number of bytes (1 to 4) of the character that `text` begins with; 0 when it does not begin
// with one: a stray or cut sequence, an overlong form, a surrogate, beyond U+10FFFF, or no text.
std::size_t utf8_length(std::string_view text);

// The longest front part of `text` that has at most `bytes` bytes and does not cut a character.
std::string_view utf8_front(std::string_view text, std::size_t bytes);

// Of one whole character.
char32_t code_point(std::string_view character);

// What a terminal obeys instead of showing it: control characters (some obey U+0080 to U+009F too),
// ends of lines, and the marks that turn the direction of the text behind them around.
bool is_obeyed_by_terminals(char32_t code);

}  // namespace lockstep
