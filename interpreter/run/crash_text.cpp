#include "run/crash_text.h"

#include <signal.h>

namespace lockstep::host {
namespace {

bool is_inside_call(const Crash& crash) {
  return crash.call.function != PluginFunction::None;
}

void put_site(const CallSite& site, SignalText& text) {
  const CallSite::Origin& origin = *site.origin;
  if (site.is_plugin()) {
    text << "the plugin '" << origin.plugin << "'";
    return;
  }
  text << "the " << origin.kind << " '" << site.shown << "' (" << origin.id;
  text << (origin.id.empty() ? "of plugin '" : " of plugin '") << origin.plugin << "')";
}

void put_culprit(const Crash& crash, SignalText& text) {
  // A call that hung may have returned while this is being reported.
  if (is_inside_call(crash) || (crash.kind == CrashKind::Hang && crash.call.site != nullptr)) {
    return put_site(*crash.call.site, text);
  }
  text << (crash.is_foreign_thread ? "a thread that a plugin has started" : "lockstep");
}

// "tick 12", "its halt function"
void put_function(const Crash& crash, SignalText& text) {
  const PluginFunction function = crash.call.function;
  if (function == PluginFunction::Tick && crash.tick != CallMark::kNoTick) {
    text << "tick " << crash.tick;
  } else if (function == PluginFunction::Load) {
    text << "the loading of its shared object";
  } else if (function == PluginFunction::End) {
    text << "its destructors or exit handlers";
  } else if (function == PluginFunction::None) {
    text << "a call";
  } else {
    text << "its " << name_of(function) << " function";
  }
}

// " (tick 12)" where the function does not say it
void put_tick(const Crash& crash, SignalText& text) {
  switch (crash.call.function) {
    case PluginFunction::Start:
    case PluginFunction::StartUnreset:
    case PluginFunction::Halt:
    case PluginFunction::Pause:
    case PluginFunction::Resume:
    case PluginFunction::Progress:
      if (crash.tick != CallMark::kNoTick) text << " (tick " << crash.tick << ")";
      break;
    default:
      break;
  }
}

void put_place(const Crash& crash, SignalText& text) {
  if (!is_inside_call(crash)) return;
  text << " in ";
  put_function(crash, text);
  put_tick(crash, text);
}

const char* name_of_signal(int number) {
  switch (number) {
    case SIGSEGV:
      return "SIGSEGV";
    case SIGBUS:
      return "SIGBUS";
    case SIGFPE:
      return "SIGFPE";
    case SIGILL:
      return "SIGILL";
    default:
      return "SIGABRT";
  }
}

const char* meaning_of(const Crash& crash) {
  switch (crash.signal) {
    case SIGSEGV:
      return crash.is_stack_overflow ? "the stack has overflowed" : "invalid memory reference";
    case SIGBUS:
      return "nonexistent memory";
    case SIGFPE:
      return crash.code == FPE_INTDIV ? "division of an integer by zero" : "erroneous arithmetic";
    case SIGILL:
      return "illegal instruction";
    default:
      return "abort() or a failed assertion";
  }
}

void put_signal(const Crash& crash, SignalText& text) {
  put_culprit(crash, text);
  text << " crashed";
  put_place(crash, text);
  text << ": " << name_of_signal(crash.signal) << ", " << meaning_of(crash);
  // A positive code is the kernel's: it knows an address.
  if ((crash.signal == SIGSEGV || crash.signal == SIGBUS) && crash.code > 0) {
    (text << " (address ").hexadecimal(crash.address) << ")";
  }
}

void put_foreign_signal(const Crash& crash, SignalText& text) {
  text << "process " << static_cast<std::uint64_t>(crash.sender) << " sent "
       << name_of_signal(crash.signal) << " while ";
  put_culprit(crash, text);
  text << (is_inside_call(crash) ? " was" : " was at work");
  put_place(crash, text);
}

void put_event(const Crash& crash, SignalText& text) {
  if (crash.kind == CrashKind::Signal) {
    return crash.sender != 0 ? put_foreign_signal(crash, text) : put_signal(crash, text);
  }
  put_culprit(crash, text);
  if (crash.kind == CrashKind::Exit) {
    text << " called exit()";
    put_place(crash, text);
    if (!is_inside_call(crash)) text << " before the work was done";
  } else if (crash.kind == CrashKind::Fork) {
    text << " forked";
    put_place(crash, text);
    text << ", and the child came back from the call; the child was ended";
  } else {
    text << " has not returned from ";
    put_function(crash, text);
    (text << " for ").tenths(crash.seconds) << " s";
    put_tick(crash, text);
  }
}

void put_hints(const Crash& crash, SignalText& text) {
  if (crash.kind == CrashKind::Fork) {
    text << "  hint: a child must call exec or _exit; the run continues without it\n";
    return;
  }
  if (crash.run.number != CallMark::kNoRun) {
    text << "  hint: this was run " << crash.run.number << " of cell " << crash.run.cell
         << ", with the seed " << crash.run.seed << "\n";
  }
  if (crash.sender != 0) return;
  constexpr const char* kForAuthor =
      "  hint: the author of the plugin needs the backtrace; addr2line -Cfe FILE.so OFFSET names "
      "the line\n";
  if (crash.is_isolated) {
    text << kForAuthor;
    return;
  }
  const bool is_local = crash.call.site != nullptr && crash.call.site->origin->is_local;
  if (is_inside_call(crash) || crash.is_foreign_thread || crash.kind == CrashKind::Hang) {
    if (!is_local || crash.is_foreign_thread) {
      text << "  hint: with --isolate --on-fault fail, the run survives a crash of this plugin\n";
    }
    text << kForAuthor;
    return;
  }
  // lockstep enables none.
  if (crash.signal == SIGFPE && crash.code > 0 && crash.code != FPE_INTDIV) {
    text << "  hint: a plugin has enabled floating-point exceptions that stop a program";
    if (crash.call.site != nullptr) {
      text << "; the last call was to ";
      put_site(*crash.call.site, text);
    }
    text << "\n" << kForAuthor;
    return;
  }
  text << "  hint: it is a bug in lockstep: please report it, with the backtrace\n";
  // Only what runs in a tree has had much occasion to do harm: the last call may be long ago.
  if (crash.call.site == nullptr || crash.call.site->is_plugin()) return;
  text
      << "  hint: unless a plugin has overwritten memory, which with --isolate it cannot; the last "
         "call was to ";
  put_site(*crash.call.site, text);
  text << "\n";
}

}  // namespace

void describe(const Crash& crash, SignalText& text) {
  text << (crash.kind == CrashKind::Fork ? "lockstep: warning: " : "lockstep: error: ");
  put_event(crash, text);
  text << "\n";
  put_hints(crash, text);
}

}  // namespace lockstep::host
