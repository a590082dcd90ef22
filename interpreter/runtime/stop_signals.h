// SIGINT and SIGTERM as a request to stop in order. Process-wide.
#pragma once

namespace lockstep {

class StopSignals {
 public:
  // From now on the first of these signals is only noted; a second one ends the process at once
  // with the exit code 128 + its number, after calling `last_words`, which must be
  // async-signal-safe. SIGPIPE is ignored: a reader that goes away must not end a run.
  static void install(void (*last_words)() = nullptr);
  // The signal that was noted, or 0. Async-signal-safe, one atomic load.
  static int received();
};

}  // namespace lockstep
