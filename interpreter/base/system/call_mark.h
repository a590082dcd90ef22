// Records which function of which plugin a thread is in, to name the cause of a crash or a hang.
// Costs four plain stores per call. The calling thread writes it; its signal handlers and the
// watchdog read it. Knows nothing about time.
#pragma once

#include <pthread.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/core/clock.h"
#include "base/system/fork_guard.h"

namespace lockstep::host {

enum class PluginFunction : std::uint8_t {
  None,  // in the host's own code
  Load,  // dlopen: the constructors of the shared object
  Describe,
  Init,
  CreateRun,
  Create,
  Start,
  StartUnreset,
  Tick,
  Halt,
  Pause,
  Resume,
  Progress,
  Run,  // the work of a thread of the leaf, for which the run waits
  Destroy,
  DestroyRun,
  Deinit,
  Retain,  // of objects
  Release,
  ToText,
  FromText,
  ToBytes,
  FromBytes,
  Reads,
  SetPace,
  Save,
  Restore,
  End,  // of a thread or the process: destructors of static objects, and what atexit was given
};

// "tick", "create_run", as lockstep/leaf.h spells them.
const char* name_of(PluginFunction function);

// The one that is called, for a message. A watchdog may look at it whenever it likes: one that `of`
// gave lives until the process ends, and the same words give the same one; those of leaves are in
// memory of which only other sites are made (call_sites.h).
struct CallSite {
  static constexpr const char* kLeaf = "leaf";
  static constexpr const char* kControlNode = "control node";
  static constexpr const char* kDecorator = "decorator";
  static constexpr const char* kObjectType = "object type";

  // The words that identify a call site.
  struct Words {
    std::string_view path = {};  // of the node, or the name of the object type; "": the plugin's
    std::string_view id = {};    // of the node's type
    std::string_view plugin = {};
    const char* kind = kLeaf;  // what `path` is
    bool is_local = false;     // the plugin cannot be isolated
  };

  // All but the path: the same for all leaves of a type.
  struct Origin {
    std::string id, plugin;
    const char* kind;
    bool is_local;
  };

  const char* path = "";           // "": it is a function of the plugin
  const char* shown = "";          // the path, as a terminal may get it
  const Origin* origin = nullptr;  // lives until the process ends

  bool is_plugin() const { return *path == '\0'; }
  // "'Main/arm' (Advance of plugin 'motion')"; "": a function of the plugin.
  std::string text() const;

  static const CallSite& of(const Words& words);
  static const CallSite& of_plugin(std::string_view name) { return of({.plugin = name}); }
  static const Origin& origin_of(const Words& words);
};

// One for each thread; see this_thread().
class CallMark {
 public:
  // Async-signal-safe.
  static CallMark& this_thread();

  // A call as another thread sees it: equal looks have seen the same call.
  struct Look {
    const CallSite* site = nullptr;  // outside of a call: of the last one
    PluginFunction function = PluginFunction::None;
    bool is_bounded = false;  // other code ensures that it returns in time
    std::uint64_t serial = 0, tick = 0;

    friend bool operator==(const Look&, const Look&) = default;
  };

  // Marks a call. Returns the one around it, for `leave`: calls may be within others.
  Look enter(const CallSite& site, PluginFunction function) {
    const Look around = as_read(function_.load(std::memory_order_relaxed));
    enter_alone(site, function);
    return around;
  }
  void leave(const Look& around) {
    ForkGuard::check();
    leave_alone();
    if (around.function == PluginFunction::None) return;
    set(*around.site, around.function);
    if (around.is_bounded) set_bounded();
  }
  // The same for a call that is within no other, around each leaf in the loops of control nodes.
  [[gnu::always_inline]] void enter_alone(const CallSite& site, PluginFunction function) {
    serial_.store(serial_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    set(site, function);
  }
  // The caller has looked whether this is a forked child.
  [[gnu::always_inline]] void leave_alone() {
    function_.store(static_cast<std::uint8_t>(PluginFunction::None), std::memory_order_release);
  }
  // Other code ensures that this call returns in time.
  void set_bounded() {
    function_.store(function_.load(std::memory_order_relaxed) | kBounded,
                    std::memory_order_release);
  }

  // The thread whose work this call waits for; 0: it does its work itself.
  void set_worker(pthread_t thread) { worker_.store(thread, std::memory_order_release); }
  pthread_t worker() const { return worker_.load(std::memory_order_acquire); }

  // The tick that the thread is in or was in last, for the message only; public numbers, from 0.
  void set_tick(std::uint64_t tick) { tick_.store(tick, std::memory_order_relaxed); }

  // The run of a study that the thread is in, for the message only.
  static constexpr std::uint64_t kNoRun = ~std::uint64_t{0};
  struct RunOfStudy {
    std::uint64_t cell = 0, number = kNoRun, seed = 0;
  };
  void set_run(const RunOfStudy& run) {
    cell_.store(run.cell, std::memory_order_relaxed);
    run_number_.store(run.number, std::memory_order_relaxed);
    seed_.store(run.seed, std::memory_order_relaxed);
  }
  RunOfStudy run() const { return {cell_.load(), run_number_.load(), seed_.load()}; }

  Look look() const;
  std::uint64_t serial() const { return serial_.load(std::memory_order_relaxed); }
  std::uint64_t tick() const { return tick_.load(std::memory_order_relaxed); }
  static constexpr std::uint64_t kNoTick = ~std::uint64_t{0};  // before the first

  // For the thread itself: the time of this call that went into the carrying of large values
  // between processes. It is lockstep's own, so the leaf that is called is not blamed for it.
  Nanoseconds carried{0};

 private:
  static constexpr std::uint8_t kBounded = 0x80;

  void set(const CallSite& site, PluginFunction function) {
    site_.store(&site, std::memory_order_release);
    function_.store(static_cast<std::uint8_t>(function), std::memory_order_release);
  }
  // The present call, with a function that was read before.
  Look as_read(std::uint8_t function) const {
    return {.site = site_.load(std::memory_order_acquire),
            .function = static_cast<PluginFunction>(function & ~kBounded),
            .is_bounded = (function & kBounded) != 0,
            .serial = serial_.load(std::memory_order_acquire),
            .tick = tick_.load(std::memory_order_acquire)};
  }

  std::atomic<const CallSite*> site_{nullptr};
  std::atomic<std::uint8_t> function_{0};  // of the call; and kBounded
  std::atomic<std::uint64_t> serial_{0}, tick_{kNoTick};
  std::atomic<pthread_t> worker_{0};
  std::atomic<std::uint64_t> cell_{0}, run_number_{kNoRun}, seed_{0};
};

namespace detail {
inline constinit thread_local CallMark t_mark;  // here, so that a call of a leaf finds it at once
}

inline CallMark& CallMark::this_thread() {
  return detail::t_mark;
}

// Marks a call for the time of its scope, also when an exception ends it.
class MarkedCall {
 public:
  MarkedCall(const CallSite& site, PluginFunction function)
      : around_(CallMark::this_thread().enter(site, function)) {}
  ~MarkedCall() { CallMark::this_thread().leave(around_); }
  MarkedCall(const MarkedCall&) = delete;
  MarkedCall& operator=(const MarkedCall&) = delete;

 private:
  const CallMark::Look around_;
};

}  // namespace lockstep::host
