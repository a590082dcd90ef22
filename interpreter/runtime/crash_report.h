// The last words of a process that a plugin brings down: a fatal signal, an exit() that is not
// ours, or a hang that the watchdog has found. Names the leaf, its plugin and the tick, writes what
// the recording still holds, then a backtrace, and ends the process with an exit code of its own.
// All of it is async-signal-safe. Process-wide.
#pragma once

#include <pthread.h>

#include "plugin/call_mark.h"

namespace lockstep {

class CrashReport {
 public:
  // From now on SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT and any exit() but exit() below end this
  // process with a report and `exit_code`. What is not caught: SIGKILL, and a stack overflow in a
  // thread that is not ours. A process that a plugin forks off ends as it would
  // without us, unless it comes back from the call: then it ends there, and is told of.
  static void install(int exit_code);
  // Called once, after the culprit is named and before the backtrace. Must be async-signal-safe.
  static void set_last_words(void (*last_words)());
  // An exit code that is none: after its report the process ends by the signal that ended it, and
  // exit() is left alone, for a parent that wants to know.
  static constexpr int kAsWithoutReport = -1;

  // The end of the process in order. An exit() of a plugin, also one in a destructor or in what it
  // gave to atexit, is a crash; results that were written stand.
  [[noreturn]] static void exit(int exit_code);
  // What every other end is to call: reports it. Returns in a process that was forked off.
  static void foreign_exit();

  // Reports that `thread`, whose mark is given, has been in a call for too long, with its backtrace
  // when it still takes a signal, and ends the process. Called by the watchdog's thread.
  [[noreturn]] static void hang(pthread_t thread, const CallMark& mark, double seconds);
};

}  // namespace lockstep
