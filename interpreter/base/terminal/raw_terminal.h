// The terminal of a program that draws on it and reads each key at once. The terminal and its
// cursor are restored however the program ends, except by SIGKILL, and while the program is stopped
// (Ctrl-Z) or in the background. Only one object at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lockstep::host {

class RawTerminal {
 public:
  // `keys` and `screen` are file descriptors of the terminal; without keys (-1) it is only drawn
  // on. Ctrl-C stays SIGINT, Ctrl-Z stays SIGTSTP. Signals that others handle are left to them:
  // they call restore_for_good().
  RawTerminal(int keys, int screen);
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  enum class State : std::uint8_t {
    Away,   // in the background: neither draw nor read
    Taken,  // just now, at first or again: draw everything again; the cursor is hidden
    Kept
  };
  // Call before drawing or reading, from one thread.
  State take();
  // The keys that were typed since the last call; does not wait. Nothing: the terminal is gone. The
  // calling thread blocks SIGTTIN.
  static std::optional<std::string> read_keys();

  // Restores the terminal for an end of the process: take() returns Away from now on.
  // Async-signal-safe.
  static void restore_for_good();
};

}  // namespace lockstep::host
