// The threads of ours that call plugins, and their ends, which are the plugins' as well: there run
// the destructors of their thread_local and static objects and what they gave to atexit.
#pragma once

#include "core/clock.h"

namespace lockstep {

// A call of this thread that lasts longer than `hang_limit` ends the process with a crash report;
// 0 = never. Until the end of the thread; for the main thread, of the process. Once is enough.
void watch_this_thread(Nanoseconds hang_limit);

// The last statement of such a thread. What plugins do from here on is a call into them.
void leave_thread_to_plugins();

// The same for the main thread: ends the process with this exit code, or with that of a crash when
// plugins hang, crash or call exit() while it ends.
[[noreturn]] void end_process(int exit_code);

}  // namespace lockstep
