#include "base/terminal/keys.h"

#include <string_view>
#include <utility>

namespace lockstep::host {
namespace {

constexpr char kEscape = '\x1b';
constexpr std::size_t kLongest = 16;  // no key's sequence is longer

// Reads the characters behind "ESC [" or "ESC O"; terminals differ.
std::optional<Key> key_of(std::string_view sequence) {
  constexpr std::pair<std::string_view, KeyKind> kKeys[] = {
      {"C", KeyKind::Right}, {"D", KeyKind::Left},    {"A", KeyKind::Up},
      {"B", KeyKind::Down},  {"5~", KeyKind::PageUp}, {"6~", KeyKind::PageDown},
      {"H", KeyKind::Home},  {"F", KeyKind::End},     {"1~", KeyKind::Home},
      {"4~", KeyKind::End},  {"7~", KeyKind::Home},   {"8~", KeyKind::End}};
  for (const auto& [text, kind] : kKeys) {
    if (text == sequence) return Key{kind};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Key> KeyDecoder::take(char byte) {
  if (byte == kEscape) {
    const bool twice = sequence_.size() == 1;
    sequence_ = byte;
    return twice ? std::optional(Key{KeyKind::Escape}) : std::nullopt;
  }
  if (!sequence_.empty()) return take_sequence(byte);
  if (byte == '\n' || byte == '\r') return Key{KeyKind::Enter};
  if (byte == '\x7f' || byte == '\b') return Key{KeyKind::Backspace};
  return Key{KeyKind::Character, byte};
}

std::optional<Key> KeyDecoder::take_sequence(char byte) {
  sequence_ += byte;
  if (sequence_.size() == 2) {
    if (byte != '[' && byte != 'O') sequence_.clear();  // Alt and a key
    return std::nullopt;
  }
  const bool last = byte >= '@' && byte <= '~';
  if (!last && sequence_.size() < kLongest) return std::nullopt;
  const std::string sequence = std::exchange(sequence_, {});
  return key_of(std::string_view(sequence).substr(2));
}

std::optional<Key> KeyDecoder::idle() {
  if (std::exchange(sequence_, {}) == std::string(1, kEscape)) return Key{KeyKind::Escape};
  return std::nullopt;
}

}  // namespace lockstep::host
