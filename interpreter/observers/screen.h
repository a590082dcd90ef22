// Draws frame over frame in place, below what a terminal has shown so far. The last frame stays.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace lockstep {

class Screen {
 public:
  explicit Screen(std::FILE* out) : out_(out) {}

  // Hides the cursor, and shows it again.
  void begin();
  void end();
  // Empties the whole screen; the next frame begins at its top.
  void clear();
  // In place of the last frame; `above` are whole lines that scroll by above it.
  void show(std::string_view above, std::string_view frame);

 private:
  void write(std::string_view text);

  std::FILE* out_;
  std::size_t lines_ = 0;  // of the last frame
};

// Makes the cursor visible again. May be called in a signal handler.
void restore_cursor(int terminal);

}  // namespace lockstep
