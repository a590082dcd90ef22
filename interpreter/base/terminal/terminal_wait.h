// Waits for a key or a change of the window size. Only one object at a time, in a process with one
// thread; used by the replay.
#pragma once

#include <cstdint>

#include "base/system/signal_mask.h"

namespace lockstep::host {

enum class TerminalEvent : std::uint8_t { None, Key, Resize };

class TerminalWait {
 public:
  explicit TerminalWait(int keys);
  ~TerminalWait();
  TerminalWait(const TerminalWait&) = delete;
  TerminalWait& operator=(const TerminalWait&) = delete;

  // A change of size between two calls is not missed. Returns None also after other signals.
  TerminalEvent wait(double seconds) const;

 private:
  int keys_;
  // Ctrl-Z comes only while wait() waits, so that keys are not read in the background after it; an
  // attempt to read them there is an error, not a stop.
  const SignalMask mask_{SIG_BLOCK, signal_set({SIGWINCH, SIGTSTP, SIGCONT, SIGTTIN})};
  struct sigaction action_before_ {};
};

}  // namespace lockstep::host
