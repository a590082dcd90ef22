// The end of a process whose last words get stuck. Async-signal-safe.
#pragma once

namespace lockstep {

// In so many seconds the process ends with this exit code, whatever the calling thread does then.
void light_fuse(unsigned seconds, int exit_code);

}  // namespace lockstep
