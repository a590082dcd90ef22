#include "runtime/plugin_thread.h"

#include <unistd.h>

#include <memory>

#include "core/own_thread.h"
#include "plugin/call_mark.h"
#include "plugin/shared_object.h"
#include "runtime/crash_report.h"
#include "runtime/watchdog.h"

namespace lockstep {

void watch_this_thread(Nanoseconds hang_limit) {
  const auto make = [&] { return std::make_unique<Watchdog>(ends_process(hang_limit)); };
  if (gettid() == getpid()) {
    static const auto& to_the_very_end = *new std::unique_ptr<Watchdog>(make());
    static_cast<void>(to_the_very_end);
  } else {
    adopt_thread();
    // The first such object of the thread, and so the last to go.
    static thread_local const std::unique_ptr<Watchdog> watchdog = make();
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

}  // namespace lockstep
