// Ends the process without exit handlers and destructors. Async-signal-safe.
#pragma once

namespace lockstep::host {

// Ends the process with this exit code after `seconds`, whatever the calling thread does.
void light_fuse(unsigned seconds, int exit_code);

// Ends the process now, like _exit, which main.cpp redefines to catch calls by plugins.
[[noreturn]] void end_at_once(int exit_code);

}  // namespace lockstep::host
