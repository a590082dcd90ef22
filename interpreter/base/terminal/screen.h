// Draws frame over frame in place, below what a terminal has shown so far. The last frame stays.
#pragma once

#include <string_view>

#include "base/terminal/outlet.h"

namespace lockstep::host {

class Screen {
 public:
  explicit Screen(Outlet& out) : out_(out) {}

  // Empties the whole screen; the next frame begins at its top.
  void clear();
  // The next frame begins where the cursor is, below what is there.
  void leave() { lines_ = 0; }
  // Replaces the last frame; `above` are whole lines that scroll by above it. Returns false if
  // nothing was drawn, because the terminal has not accepted the previous output yet.
  bool show(std::string_view above, std::string_view frame);

 private:
  Outlet& out_;
  std::size_t lines_ = 0;  // of the last frame
};

// May be called in a signal handler, and do not wait.
void hide_cursor(int terminal);
void show_cursor(int terminal);

}  // namespace lockstep::host
