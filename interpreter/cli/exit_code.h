// How lockstep ends: an interface, documented in docs/cli.md.
#pragma once

namespace lockstep::host {

enum ExitCode : int {
  kExitSuccess = 0,
  kExitFailure = 1,
  kExitUsage = 2,
  kExitInvalidTree = 3,
  kExitPluginRefused = 4,
  kExitLeafFault = 5,
  kExitLeafCrash = 6,  // a plugin crashed or hung in this process
  kExitOverrun = 7,    // --overrun fail
  kExitRecording = 8,  // --on-record-error stop
  kExitInternal = 9,   // lockstep itself failed: out of memory, an unexpected exception
  kExitProperty = 10,  // --on-violation end
  kExitLimit = 124,    // --timeout or --max-ticks
  kExitSignal = 128,   // + the signal
};

// The first of two exit codes, unless it is a success.
constexpr int first_failure(int first, int second) {
  return first == kExitSuccess ? second : first;
}

}  // namespace lockstep::host
