// SIGINT and SIGTERM as a request to stop in order. Process-wide.
#pragma once

namespace lockstep {

class StopSignals {
 public:
  // From now on the first of these signals is only noted; a second one ends the process at once
  // with the exit code 128 + its number.
  static void install();
  // The signal that was noted, or 0. Async-signal-safe, one atomic load.
  static int received();
};

}  // namespace lockstep
