// The threads of lockstep that call plugins. Their ends run code of plugins too: destructors of
// thread_local and static objects, and atexit handlers.
#pragma once

#include "base/core/clock.h"

namespace lockstep::host {

// A call of this thread that lasts longer than `hang_limit` ends the process with a crash report;
// 0 = never. Until the end of the thread; for the main thread, of the process. Once is enough.
void watch_this_thread(Nanoseconds hang_limit);

// The last statement of such a thread. From now on, code of plugins counts as a call.
void leave_thread_to_plugins();

// The same for the main thread: ends the process with this exit code, or with that of a crash when
// plugins hang, crash or call exit() while it ends.
[[noreturn]] void end_process(int exit_code);

}  // namespace lockstep::host
