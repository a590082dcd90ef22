// Queries the terminal: its size and its character set.
#pragma once

namespace lockstep::host {

struct TerminalSize {
  unsigned width = 80, height = 24;

  friend bool operator==(const TerminalSize&, const TerminalSize&) = default;
};

// 80 x 24 when it is not known.
TerminalSize terminal_size(int file);
// False with TERM=dumb: the cursor cannot move, so nothing can be drawn in place.
bool can_draw();
// LC_ALL, LC_CTYPE or LANG, the first that is set, names UTF-8.
bool has_unicode();

}  // namespace lockstep::host
