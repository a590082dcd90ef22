#include "run/plugin_thread.h"

#include <unistd.h>

#include <cstddef>
#include <new>

#include "base/system/call_mark.h"
#include "base/system/own_thread.h"
#include "leaves/plugin/open/shared_object.h"
#include "run/crash_report.h"
#include "run/watchdog.h"

namespace lockstep::host {

void watch_this_thread(Nanoseconds hang_limit) {
  if (gettid() == getpid()) {
    // Never destroyed: it watches to the very end.
    alignas(Watchdog) static std::byte memory[sizeof(Watchdog)];
    static const auto* const watchdog = new (memory) Watchdog(ends_process(hang_limit));
    static_cast<void>(watchdog);
  } else {
    adopt_thread();
    // The first such object of the thread, and so the last to go.
    static thread_local const Watchdog watchdog(ends_process(hang_limit));
  }
}

void leave_thread_to_plugins() {
  if (const CallSite* const plugins = opened_shared_objects()) {
    CallMark::this_thread().enter(*plugins, PluginFunction::End);
  }
}

void end_process(int exit_code) {
  leave_thread_to_plugins();
  CrashReport::exit(exit_code);
}

}  // namespace lockstep::host
