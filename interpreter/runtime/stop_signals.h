// Signals as a request to stop in order: every one that would end the process otherwise and is not
// a crash. Process-wide.
#pragma once

#include <span>

namespace lockstep {

class StopSignals {
 public:
  // From now on the first of these signals is only noted. A second one from somebody who is tired
  // of waiting (SIGINT, SIGQUIT, SIGTERM) ends the process within a second, with the exit code 128
  // + its number, after calling `last_words`, which must be async-signal-safe. A signal that is
  // ignored already stays so, as SIGHUP under nohup, unless it is one of these three.
  static void install(void (*last_words)() = nullptr);
  // The signal that was noted, or 0. Async-signal-safe, one atomic load.
  static int received();
  // Those that are taken.
  static std::span<const int> numbers();
};

}  // namespace lockstep
