// A terminal that hands over each key at once and shows none, while this lives. However the program
// ends, except by SIGKILL, the terminal is left as it was, with its cursor. One at a time.
#pragma once

namespace lockstep {

class RawTerminal {
 public:
  // `keys` and `screen` are file descriptors of the terminal. Ctrl-C stays SIGINT.
  RawTerminal(int keys, int screen);
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  // Stops the process, as Ctrl-Z does, with the terminal as it was; returns when it goes on.
  void suspend();

  // As it was before. Async-signal-safe.
  static void restore();
};

}  // namespace lockstep
