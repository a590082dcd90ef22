// A thread that takes no signals: they are for the tick thread, whose sleep they must end. Those of
// a crash are for whoever crashes.
#pragma once

#include <signal.h>

#include <thread>
#include <utility>

#include "runtime/crash_report.h"

namespace lockstep {

template <class Function>
std::thread quiet_thread(Function function) {
  sigset_t all, before;
  sigfillset(&all);
  for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) sigdelset(&all, crash);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread([function = std::move(function)]() mutable {
    CrashReport::prepare_thread();
    function();
  });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace lockstep
