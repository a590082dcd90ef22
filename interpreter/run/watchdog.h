// One thread that watches the calls of all other threads and reports a call that does not return.
// It costs those threads nothing. It looks at a TickAlarm too. It also handles the stop signals, so
// a leaf that blocks them in the tick thread cannot prevent a stop.
#pragma once

#include <functional>
#include <memory>

#include "base/core/clock.h"
#include "base/system/call_mark.h"
#include "base/system/tick_alarm.h"

namespace lockstep::host {

struct WatchdogOptions {
  Nanoseconds hang_limit{0};  // a call that lasts longer, unless it is bounded; 0 = never
  Nanoseconds halt_limit{0};  // a halt that lasts longer is reported once; 0 = never
  // Called on the watching thread, which must not construct or destroy a watchdog then.
  std::function<void(const CallMark::Look& call, Nanoseconds lasts)> on_long_halt = {};
  std::function<void(const CallMark::Look& call, Nanoseconds lasts)> on_hang =
      {};                       // may not return
  TickAlarm* alarm = nullptr;   // must outlive the watchdog; null: none
  bool handles_signals = true;  // in the watching thread; false: they are another program's
};

class Watchdog {
 public:
  // Watches the calls of the thread that constructs it.
  explicit Watchdog(WatchdogOptions options);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  class Patrol;
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

// For the thread that calls this: a call that lasts longer than `hang_limit` (0 = never) ends the
// process with a crash report.
WatchdogOptions ends_process(Nanoseconds hang_limit);

}  // namespace lockstep::host
