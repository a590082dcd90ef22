// Reports that a plugin ends the process: by a fatal signal, by an exit() that is not ours, or by a
// hang that the watchdog has found. Names the leaf, its plugin and the tick, writes the rest of the
// recording and a backtrace, and ends the process with its own exit code. Everything is
// async-signal-safe. Process-wide.
#pragma once

#include <pthread.h>

#include "base/system/call_mark.h"

namespace lockstep::host {

class CrashReport {
 public:
  // From now on SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT and any exit() but exit() below end this
  // process with a report and `exit_code`. Not caught are SIGKILL, and a stack overflow in a thread
  // that is not ours. A process that a plugin forks ends as it would without us, unless it returns
  // from the call: then it ends there, and is reported.
  static void install(int exit_code);
  // Called once, after the culprit is named and before the backtrace. Must be async-signal-safe.
  static void set_last_words(void (*last_words)());
  // Instead of an exit code: after the report the process ends by the original signal, and exit()
  // is not caught, so that the parent learns the cause.
  static constexpr int kAsWithoutReport = -1;

  // Ends the process in order. An exit() of a plugin, also in a destructor or an atexit handler, is
  // a crash; results that were already written stay valid.
  [[noreturn]] static void exit(int exit_code);
  // Every other end must call this: it reports the end. Returns in a forked process.
  static void foreign_exit();

  // Reports that `thread`, with this mark, has been in a call for too long, and ends the process;
  // with its backtrace, or that of the worker that it waits for, if it still handles a signal.
  [[noreturn]] static void hang(pthread_t thread, const CallMark& mark, double seconds);
};

}  // namespace lockstep::host
