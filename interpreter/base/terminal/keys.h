// Parses the bytes that a terminal sends, one at a time, into keys.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lockstep::host {

enum class KeyKind : std::uint8_t {
  Character,
  Left,
  Right,
  Up,
  Down,
  PageUp,
  PageDown,
  Home,
  End,
  Enter,
  Backspace,
  Escape
};

struct Key {
  KeyKind kind = KeyKind::Character;
  char character = '\0';  // of a Character

  friend bool operator==(const Key&, const Key&) = default;
};

class KeyDecoder {
 public:
  // The key that ends with this byte, if any. Unknown keys are skipped.
  std::optional<Key> take(char byte);
  // No byte has come for a while, so a pending escape was the escape key.
  std::optional<Key> idle();

 private:
  std::optional<Key> take_sequence(char byte);

  std::string sequence_;  // what has come since an escape, with it
};

}  // namespace lockstep::host
