// Processes that end with a report. Each is a child of the test.
#include "run/crash_report.h"

#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <thread>

#include "base/system/own_thread.h"
#include "run/watchdog.h"
#include "unit/runtime/forked_child.h"

namespace lockstep::host::test {
namespace {

constexpr int kCrashed = 42;
const CallSite& arm_leaf = CallSite::of({.path = "Main/arm", .id = "Advance", .plugin = "motion"});
const std::string kArmError = "lockstep: error: the leaf 'Main/arm' (Advance of plugin 'motion') ";

void say(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) _exit(99);
}
void last_words() {
  say("last words\n");
}

// What sanitizers would find before the processor does.
#define LOCKSTEP_UNCHECKED __attribute__((noinline, no_sanitize("address", "undefined", "thread")))

LOCKSTEP_UNCHECKED void write_to(std::uintptr_t address) {
  volatile std::uintptr_t hidden = address;
  *reinterpret_cast<volatile char*>(hidden) = 1;  // NOLINT: it must crash
}

LOCKSTEP_UNCHECKED void divide_by_zero() {
#if defined(__x86_64__)
  volatile int seven = 7, zero = 0;
  volatile int result = seven / zero;  // NOLINT: it must crash
  static_cast<void>(result);
#else
  raise(SIGFPE);
#endif
}

LOCKSTEP_UNCHECKED int overflow(int depth) {  // NOLINT(misc-no-recursion)
  volatile char frame[8192];
  frame[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : overflow(depth + 1) + frame[0];
}

// `body` in the leaf's tick 12.
Ended in_tick(const std::function<void()>& body, void (*words)() = last_words) {
  return in_child([&] {
    CrashReport::install(kCrashed);
    CrashReport::set_last_words(words);
    CallMark::this_thread().set_tick(12);
    const MarkedCall call(arm_leaf, PluginFunction::Tick);
    body();
  });
}

// `body` outside of all calls.
Ended outside(const std::function<void()>& body) {
  return in_child([&] {
    CrashReport::install(kCrashed);
    CrashReport::set_last_words(last_words);
    body();
  });
}

bool has(const Ended& ended, const std::string& text) {
  return ended.said.find(text) != std::string::npos;
}

void check_report(const Ended& ended, const std::string& first_line) {
  INFO(ended.said << "exit code " << ended.exit_code << ", signal " << ended.signal);
  CHECK(ended.exit_code == kCrashed);
  CHECK(ended.said.substr(0, ended.said.find('\n')) == first_line);
  const std::size_t words = ended.said.find("\nlast words\n");
  const std::size_t backtrace = ended.said.find("\nlockstep: backtrace:\n");
  CHECK(words != std::string::npos);
  CHECK(backtrace != std::string::npos);
  CHECK(words < backtrace);
  CHECK(ended.said.find("test_", backtrace) != std::string::npos);  // this program's own frames
}

TEST_CASE(
    "a crash is reported with leaf, tick and signal, then come the last words and a backtrace") {
  check_report(in_tick([] { write_to(0x10); }),
               kArmError + "crashed in tick 12: SIGSEGV, invalid memory reference (address 0x10)");
  check_report(in_tick([] { divide_by_zero(); }),
               kArmError + "crashed in tick 12: SIGFPE, division of an integer by zero");
  check_report(in_tick([] { std::abort(); }),
               kArmError + "crashed in tick 12: SIGABRT, abort() or a failed assertion");
  check_report(in_tick([] { raise(SIGILL); }),
               kArmError + "crashed in tick 12: SIGILL, illegal instruction");
  check_report(in_tick([] { raise(SIGBUS); }),
               kArmError + "crashed in tick 12: SIGBUS, nonexistent memory");
}

TEST_CASE("a stack overflow is reported on a separate stack") {
  const Ended ended = in_tick([] { overflow(0); });
  CHECK(ended.exit_code == kCrashed);
  CHECK(
      has(ended, kArmError + "crashed in tick 12: SIGSEGV, the stack has overflowed (address 0x"));
  CHECK(has(ended, "last words\n"));
  CHECK(has(ended, "lockstep: backtrace:\n"));
}

TEST_CASE("a stack overflow in a thread of lockstep is reported, too") {
  const Ended ended = outside([] {
    std::thread([] {
      adopt_thread();
      const MarkedCall call(arm_leaf, PluginFunction::Create);
      overflow(0);
    }).join();
  });
  CHECK(ended.exit_code == kCrashed);
  CHECK(
      has(ended, kArmError + "crashed in its create function: SIGSEGV, the stack has overflowed"));
}

TEST_CASE("exit inside a call is a crash") {
  check_report(in_tick([] { std::exit(0); }), kArmError + "called exit() in tick 12");
  check_report(in_tick([] { std::quick_exit(0); }), kArmError + "called exit() in tick 12");
}

TEST_CASE("exit in a thread of a plugin is a crash until our work is done") {
  check_report(
      outside([] { std::thread([] { std::quick_exit(0); }).join(); }),
      "lockstep: error: a thread that a plugin has started called exit() before the work was done");
}

TEST_CASE("our own exit is an exit, and what was given to atexit is done") {
  const Ended ended = outside([] {
    { const MarkedCall call(arm_leaf, PluginFunction::Tick); }
    std::atexit([] { say("done\n"); });
    CrashReport::exit(7);
  });
  CHECK(ended.exit_code == 7);
  CHECK(ended.said == "done\n");
}

struct ExitsWithItsThread {
  ~ExitsWithItsThread() { std::exit(7); }
};

TEST_CASE("exit of a plugin within our own exit is a crash, whatever its code") {
  const auto end = [] {
    CallMark::this_thread().enter(CallSite::of_plugin("motion"), PluginFunction::End);
    CrashReport::exit(7);
  };
  const std::string line =
      "lockstep: error: the plugin 'motion' called exit() in its destructors or exit handlers";
  check_report(outside([&] {
                 std::atexit([] { std::exit(7); });
                 end();
               }),
               line);
  check_report(outside([&] {
                 static thread_local const ExitsWithItsThread it;
                 static_cast<void>(it);
                 end();
               }),
               line);
}

TEST_CASE("what a plugin gave to atexit is watched") {
  const Ended ended = outside([] {
    std::atexit([] {
      while (true) pause();
    });
    const Watchdog watchdog(ends_process(std::chrono::milliseconds(100)));
    CallMark::this_thread().enter(CallSite::of_plugin("motion"), PluginFunction::End);
    CrashReport::exit(7);
  });
  CHECK(ended.exit_code == kCrashed);
  CHECK(
      has(ended,
          "the plugin 'motion' has not returned from its destructors or exit handlers for 0.1 s"));
}

TEST_CASE("a crash in a thread that a plugin started is not that of a leaf") {
  check_report(
      in_tick([] { std::thread([] { write_to(0x10); }).join(); }),
      "lockstep: error: a thread that a plugin has started crashed: SIGSEGV, invalid memory "
      "reference (address 0x10)");
}

TEST_CASE("a crash of lockstep is reported as such") {
  const Ended ended = outside([] { write_to(0x10); });
  check_report(ended,
               "lockstep: error: lockstep crashed: SIGSEGV, invalid memory reference "
               "(address 0x10)");
  CHECK(has(ended, "a bug in lockstep"));
}

TEST_CASE("a crash of the report itself ends the process at once") {
  const Ended ended = in_tick([] { std::abort(); }, [] { write_to(0x10); });
  CHECK(ended.exit_code == kCrashed);
  CHECK(has(ended, "crashed in tick 12"));
  CHECK_FALSE(has(ended, "SIGSEGV"));
  CHECK_FALSE(has(ended, "backtrace:"));
}

TEST_CASE("of two threads that crash at once one reports") {
  const Ended ended = outside([] {
    std::atomic<int> ready{0};
    const auto crash = [&] {
      ++ready;
      while (ready < 2) std::this_thread::yield();
      write_to(0x10);
    };
    std::thread other(crash);
    crash();
  });
  CHECK(ended.exit_code == kCrashed);
  CHECK(ended.said.find("lockstep: error:") == ended.said.rfind("lockstep: error:"));
  CHECK(has(ended, "lockstep: backtrace:\n"));
}

// A thread that tells that the caller of this function hangs. It must not return before that.
std::thread tell_hang() {
  return std::thread([thread = pthread_self(), &mark = CallMark::this_thread()] {
    CrashReport::hang(thread, mark, 2);
  });
}

TEST_CASE("a hang is reported with the backtrace of the thread that hangs") {
  check_report(in_tick([] { tell_hang().join(); }),
               kArmError + "has not returned from tick 12 for 2.0 s");
}

TEST_CASE("a hang of a thread that takes no signal is reported without a backtrace") {
  const Ended ended = in_tick([] {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, nullptr);
    tell_hang().join();
  });
  CHECK(ended.exit_code == kCrashed);
  CHECK(has(ended, kArmError + "has not returned from tick 12 for 2.0 s"));
  CHECK(has(ended, "last words\n"));
  CHECK_FALSE(has(ended, "backtrace:\n"));
}

// Forked off without the C library, which therefore cannot know.
pid_t raw_fork() {
  return static_cast<pid_t>(syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0));
}

TEST_CASE("a child that comes back from the call is reported and ends there") {
  for (pid_t (*forked)() : {static_cast<pid_t (*)()>(fork), raw_fork}) {
    const Ended ended = in_tick([&] {
      int status = 0;
      {
        const MarkedCall call(arm_leaf, PluginFunction::Halt);
        const pid_t child = forked();
        if (child == 0) return;
        waitpid(child, &status, 0);
      }
      _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 99);
    });
    CHECK(ended.exit_code == 1);
    CHECK(ended.said ==
          "lockstep: warning: the leaf 'Main/arm' (Advance of plugin 'motion') forked in its halt "
          "function (tick 12), and the child came back from the call; the child was ended\n"
          "  hint: a child must call exec or _exit; the run continues without it\n");
  }
}

TEST_CASE("what a process does that a leaf forks off is its own matter") {
  const auto status_of = [](void (*end)()) {
    const pid_t child = fork();
    if (child == 0) end();
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  };
  const Ended ended = in_tick([&] {
    const int aborted = status_of([] { std::abort(); });
    const int crashed = status_of([] { write_to(0x10); });
    const int left = status_of([] { std::quick_exit(7); });
    const bool good = WIFSIGNALED(aborted) && WTERMSIG(aborted) == SIGABRT &&
                      WIFSIGNALED(crashed) && WTERMSIG(crashed) == SIGSEGV && WIFEXITED(left) &&
                      WEXITSTATUS(left) == 7;
    _exit(good ? 0 : 1);
  });
  CHECK(ended.exit_code == 0);
  CHECK(ended.said.empty());
}

TEST_CASE("a fatal signal from another process is reported as such") {
  const Ended ended = in_tick([] {
    const pid_t crashing = getpid();
    std::array<int, 2> forked{};
    if (pipe(forked.data()) != 0) return;
    char byte = 0;
    if (fork() == 0) {
      // The sanitizers must not be hit within their fork.
      if (read(forked[0], &byte, 1) == 1) kill(crashing, SIGABRT);
      _exit(0);
    }
    if (write(forked[1], &byte, 1) == 1) pause();
  });
  CHECK(ended.exit_code == kCrashed);
  CHECK(has(ended,
            " sent SIGABRT while the leaf 'Main/arm' (Advance of plugin 'motion') was in "
            "tick 12\n"));
}

}  // namespace
}  // namespace lockstep::host::test
