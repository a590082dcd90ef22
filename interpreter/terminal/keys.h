// What a terminal sends while somebody presses keys, one byte at a time, as keys.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lockstep {

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
  // The key that ends with this byte, if one does. Keys that nobody here needs are skipped.
  std::optional<Key> take(char byte);
  // Nothing has come for a while: an escape that waits for more was the key of that name.
  std::optional<Key> idle();

 private:
  std::optional<Key> take_sequence(char byte);

  std::string sequence_;  // what has come since an escape, with it
};

}  // namespace lockstep
