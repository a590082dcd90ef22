// What the terminal can do, asked of the system: size and characters.
#pragma once

namespace lockstep {

struct TerminalSize {
  unsigned width = 80, height = 24;

  friend bool operator==(const TerminalSize&, const TerminalSize&) = default;
};

// 80 x 24 when it is not known.
TerminalSize terminal_size(int file);
// False with TERM=dumb: the cursor cannot be moved, nothing be drawn in place.
bool can_draw();
// LC_ALL, LC_CTYPE or LANG, the first that is set, names UTF-8.
bool has_unicode();

}  // namespace lockstep
