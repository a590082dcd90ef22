// Ends of a process without its exit handlers and destructors. Async-signal-safe.
#pragma once

namespace lockstep {

// In so many seconds the process ends with this exit code, whatever the calling thread does then.
void light_fuse(unsigned seconds, int exit_code);

// Now. What _exit does: that name is for plugins, whose end it is not (main.cpp).
[[noreturn]] void end_at_once(int exit_code);

}  // namespace lockstep
