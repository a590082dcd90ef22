#include "run/crash_report.h"

#include <execinfo.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <ctime>

#include "base/system/descriptors.h"
#include "base/system/fork_guard.h"
#include "base/system/own_thread.h"
#include "base/system/signal_mask.h"
#include "base/terminal/outlet.h"
#include "run/crash_text.h"
#include "run/fuse.h"

namespace lockstep::host {
namespace {

constexpr std::array kFatalSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr unsigned kLongestReport = 5;  // seconds; then the process ends without the rest
constexpr std::chrono::milliseconds kBeforeReport{200};
constexpr int kMostFrames = 64;

// Written by install(), before anything can crash.
int g_exit_code = 1;
pid_t g_process = 0;
std::atomic<void (*)()> g_crash_words{nullptr};

// Our own exit() is called with this number: the system keeps its last byte, the exit code. A
// plugin has no reason to call it with the same.
constexpr int kOurExit = 0x6c730000;
std::atomic<int> g_our_status{kOurExit - 1};

std::atomic<pid_t> g_reporter{0};  // the thread that writes the report
WayToEnd g_end;                    // behind the report, written by that thread

// The report that hang() passes to the hanging thread. Written before the flag.
pthread_t g_hung_thread;
Crash g_hang;
std::atomic<bool> g_is_hung{false};

struct Registers {
  std::uint64_t stack = 0;
  void* instruction = nullptr;
};

Registers registers_of(const void* context) {
  [[maybe_unused]] const auto& machine = static_cast<const ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
  return {static_cast<std::uint64_t>(machine.gregs[REG_RSP]),
          reinterpret_cast<void*>(machine.gregs[REG_RIP])};  // NOLINT: an address
#elif defined(__aarch64__)
  return {machine.sp, reinterpret_cast<void*>(machine.pc)};
#else
  return {};
#endif
}

// By the signal, as the process would have ended without a report; or with our exit code.
WayToEnd end_by(int signal) {
  return {g_exit_code, g_exit_code == CrashReport::kAsWithoutReport ? signal : 0};
}

// The first thread that crashes reports, others wait for its end. A crash of the report itself ends
// the process at once, as the backtrace of a jump to a wild address does; and so does a report that
// gets stuck.
void begin_report(int signal = 0) {
  const auto thread = static_cast<pid_t>(syscall(SYS_gettid));
  pid_t reporter = 0;
  if (!g_reporter.compare_exchange_strong(reporter, thread)) {
    if (reporter == thread) end_at_once(g_end);
    while (true) pause();
  }
  g_end = end_by(signal);
  unblock(signal_set(kFatalSignals));
  light_fuse(kLongestReport, g_end);
  messages().flush(kBeforeReport);  // earlier messages
}

// From the instruction that crashed, when it is among them: what was called before is the handler.
void write_backtrace(const void* instruction) {
  std::array<void*, kMostFrames> frames;
  const int count = backtrace(frames.data(), kMostFrames);
  int first = 0;
  while (first < count && frames[static_cast<std::size_t>(first)] != instruction) ++first;
  if (first == count) first = 0;
  write_now(STDERR_FILENO, "lockstep: backtrace:\n");
  // Through memory, because its reader may not read.
  const int memory = memfd_create("backtrace", MFD_CLOEXEC);
  backtrace_symbols_fd(frames.data() + first, count - first, memory);
  lseek(memory, 0, SEEK_SET);
  std::array<char, 1024> text;
  for (ssize_t size; (size = read(memory, text.data(), text.size())) > 0;) {
    write_now(STDERR_FILENO, {text.data(), static_cast<std::size_t>(size)});
  }
}

enum class Backtrace : bool { No, Yes };

[[noreturn]] void report(const Crash& crash, Backtrace wanted, const void* instruction = nullptr) {
  SignalText text;
  describe(crash, text);
  write_now(STDERR_FILENO, text.text());
  if (const auto last_words = g_crash_words.load()) last_words();
  if (wanted == Backtrace::Yes) write_backtrace(instruction);
  end_at_once(g_end);
}

Crash crash_here(CrashKind kind) {
  const CallMark& mark = CallMark::this_thread();
  return {.kind = kind,
          .call = mark.look(),
          .tick = mark.tick(),
          .run = mark.run(),
          .is_foreign_thread = !is_own_thread(),
          .is_isolated = g_exit_code == CrashReport::kAsWithoutReport};
}

Crash crash_of(int number, const siginfo_t& info, const Registers& registers) {
  constexpr std::uint64_t kNear = std::uint64_t{64} << 10;
  Crash crash = crash_here(CrashKind::Signal);
  crash.signal = number;
  crash.code = info.si_code;
  if (info.si_code <= 0) {  // somebody's kill() or raise()
    if (info.si_pid != getpid()) crash.sender = info.si_pid;
    return crash;
  }
  crash.address = reinterpret_cast<std::uintptr_t>(info.si_addr);
  crash.is_stack_overflow =
      number == SIGSEGV && crash.address + kNear - registers.stack < 2 * kNear;
  return crash;
}

void on_fatal_signal(int number, siginfo_t* info, void* context) {
  if (ForkGuard::is_child()) {
    signal(number, SIG_DFL);
    raise(number);
    return;
  }
  const bool is_hang =
      number == SIGABRT && g_is_hung && pthread_equal(pthread_self(), g_hung_thread) != 0;
  begin_report(is_hang ? 0 : number);
  const Registers registers = registers_of(context);
  if (is_hang) report(g_hang, Backtrace::Yes, registers.instruction);
  report(crash_of(number, *info, registers), Backtrace::Yes, registers.instruction);
}

// exit() begins with the destructors of thread_local objects: this one has come to life in our own
// exit(), after they had gone.
struct ExitWithinExit {
  ~ExitWithinExit() { CrashReport::foreign_exit(); }
};

// The last of what was given to atexit, since it was the first. The destructors of shared objects
// are still to come.
void at_exit(int status, void* /*nothing*/) {
  if (status != g_our_status) return CrashReport::foreign_exit();
  static thread_local const ExitWithinExit detector;
  static_cast<void>(detector);
}

// Several threads of a study may call exit() at once. A thread that finds no handler left ends the
// process, also in the middle of the report of another: so there is one for each.
bool register_exit_handlers() {
  constexpr int kMostThreads = 1100;
  bool good = true;
  for (int thread = 0; thread < kMostThreads; ++thread) {
    good &= on_exit(at_exit, nullptr) == 0 && std::at_quick_exit(CrashReport::foreign_exit) == 0;
  }
  return good;
}

// A child that a plugin has forked off, and that has come back from the call.
void end_child() {
  SignalText text;
  describe(crash_here(CrashKind::Fork), text);
  write_now(STDERR_FILENO, text.text());
  end_at_once(1);
}

}  // namespace

void CrashReport::install(int exit_code) {
  g_exit_code = exit_code;
  g_process = getpid();
  ForkGuard::arm(end_child);
  adopt_thread();
  messages();  // made, before a signal handler asks for it
  std::array<void*, 1> frame;
  backtrace(frame.data(), 1);  // the first call loads a library, which a signal handler must not
  struct sigaction action {};
  action.sa_sigaction = on_fatal_signal;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
  sigfillset(&action.sa_mask);
  sigdelset(&action.sa_mask, SIGALRM);
  for (const int number : kFatalSignals) sigdelset(&action.sa_mask, number);
  for (const int number : kFatalSignals) sigaction(number, &action, nullptr);
  static const bool registered = register_exit_handlers();
  static_cast<void>(registered);
}

void CrashReport::set_last_words(void (*last_words)()) {
  g_crash_words = last_words;
}

void CrashReport::exit(int exit_code) {
  g_our_status = kOurExit | exit_code;
  std::exit(g_our_status);
}

void CrashReport::foreign_exit() {
  // The number also identifies a child that shares our memory, as after vfork.
  if (getpid() != g_process || g_exit_code == CrashReport::kAsWithoutReport) return;
  begin_report();
  report(crash_here(CrashKind::Exit), Backtrace::Yes);
}

void CrashReport::hang(pthread_t thread, const CallMark& mark, double seconds) {
  const pthread_t worker = mark.worker();
  g_hung_thread = worker != 0 ? worker : thread;
  g_hang = {.kind = CrashKind::Hang,
            .call = mark.look(),
            .tick = mark.tick(),
            .run = mark.run(),
            .seconds = seconds};
  g_is_hung = true;
  pthread_kill(g_hung_thread, SIGABRT);
  const timespec pause_time{.tv_sec = 0, .tv_nsec = 5'000'000};
  for (int look = 0; look < 40 && g_reporter == 0; ++look) nanosleep(&pause_time, nullptr);
  begin_report();
  report(g_hang, Backtrace::No);
}

}  // namespace lockstep::host
