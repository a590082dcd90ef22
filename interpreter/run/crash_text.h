// The text of a crash report. Everything here is async-signal-safe. Used by crash_report.cpp.
#pragma once

#include <sys/types.h>

#include <cstdint>

#include "base/system/call_mark.h"
#include "run/signal_text.h"

namespace lockstep::host {

enum class CrashKind : std::uint8_t { Signal, Exit, Hang, Fork };

struct Crash {
  CrashKind kind;
  CallMark::Look call;             // of the thread that crashed
  std::uint64_t tick;              // as in CallMark
  CallMark::RunOfStudy run = {};   // as in CallMark
  bool is_foreign_thread = false;  // not one of lockstep's own
  int signal = 0;                  // the rest of a signal: its number,
  int code = 0;                    // si_code,
  std::uint64_t address = 0;       // si_addr,
  bool is_stack_overflow = false;  // whether that is just beyond the stack,
  pid_t sender = 0;                // and the other process that sent it, if any
  double seconds = 0;              // of a hang
  bool is_isolated = false;        // in a process that runs only the plugin
};

// Lines for a person: what happened, and hints about what to do.
void describe(const Crash& crash, SignalText& text);

}  // namespace lockstep::host
