// The last words of a process that a plugin brings down: a fatal signal, exit() inside a call, or a
// hang that the watchdog has found. Names the leaf, its plugin and the tick, writes what the
// recording still holds, then a backtrace, and ends the process with an exit code of its own. All
// of it is async-signal-safe. Process-wide.
#pragma once

#include <pthread.h>

#include "plugin/call_mark.h"

namespace lockstep {

class CrashReport {
 public:
  // From now on SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT and exit() of this process end with a
  // report and `exit_code`. `last_words` may be null; it must be async-signal-safe, and is called
  // once, after the culprit is named and before the backtrace. What is not caught: _exit(),
  // SIGKILL, and a stack overflow in a thread that is not ours. A process that a plugin forks
  // off is none of our business: its end is as without us.
  static void install(int exit_code, void (*last_words)());
  // An exit code that is none: after its report the process ends by the signal that ended it, and
  // exit() is left alone, for a parent that wants to know.
  static constexpr int kAsWithoutReport = -1;

  // exit() and quick_exit() are a crash inside a call, and in any thread as long as a run goes on:
  // begin_run() .. end_run(). (A leaf may call it from a thread of its own.)
  static void begin_run();
  static void end_run();

  // Reports that `thread`, whose mark is given, has been in a call for too long, with its backtrace
  // when it still takes a signal, and ends the process. Called by the watchdog's thread.
  [[noreturn]] static void hang(pthread_t thread, const CallMark& mark, double seconds);
};

}  // namespace lockstep
