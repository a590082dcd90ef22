// Signals that request an orderly stop: every signal that would otherwise end the process and is
// not a crash. Process-wide.
#pragma once

#include <span>

namespace lockstep::host {

class StopSignals {
 public:
  // From now on the first of these signals is only noted. A second one (SIGINT, SIGQUIT, SIGTERM)
  // ends the process within a second, with the exit code 128 + its number, after calling
  // `last_words`, which must be async-signal-safe. A signal that is already ignored stays ignored,
  // as SIGHUP under nohup, unless it is one of these three.
  static void install(void (*last_words)() = nullptr);
  // The signal that was noted, or 0. Async-signal-safe, one atomic load.
  static int received();
  // The handled signals.
  static std::span<const int> numbers();
};

}  // namespace lockstep::host
