// Ends the process without exit handlers and destructors. Async-signal-safe.
#pragma once

namespace lockstep::host {

// How the process ends: with an exit code or, if `signal` is not 0, by that.
struct WayToEnd {
  int exit_code = 0, signal = 0;
};

// Ends the process so after `seconds`, whatever the calling thread does.
void light_fuse(unsigned seconds, WayToEnd end);

// Ends the process now, like _exit, which main.cpp redefines to catch calls by plugins.
[[noreturn]] void end_at_once(int exit_code);
[[noreturn]] void end_at_once(WayToEnd end);

}  // namespace lockstep::host
