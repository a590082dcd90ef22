// Records which function of which plugin a thread is in, to name the cause of a crash or a hang.
// Costs two plain stores per call. The calling thread writes it; its signal handlers and the
// watchdog read it. Knows nothing about time.
#pragma once

#include <pthread.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "system/fork_guard.h"

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
  End,  // of a thread or the process: destructors of static objects, and what atexit was given
};

// "tick", "create_run", as lockstep/leaf.h spells them.
const char* name_of(PluginFunction function);

// The one that is called, in words for a message. One that `of` gave lives until the process ends,
// because a watchdog may look at it whenever it likes; the same words give the same one.
struct CallSite {
  static constexpr const char* kLeaf = "leaf";
  static constexpr const char* kControlNode = "control node";
  static constexpr const char* kDecorator = "decorator";
  static constexpr const char* kObjectType = "object type";

  // What identifies one.
  struct Words {
    std::string_view path = {};  // of the node, or the name of the object type; "": the plugin's
    std::string_view id = {};    // of the node's type
    std::string_view plugin = {};
    const char* kind = kLeaf;  // what `path` is
    bool is_local = false;     // the plugin cannot be isolated

    bool operator==(const Words& other) const;
  };

  std::string path, id, plugin;
  const char* kind = kLeaf;
  bool is_local = false;
  std::string text = {};  // "'Main/arm' (Advance of plugin 'motion')"; "": a function of the plugin

  static const CallSite& of(const Words& words);
  static const CallSite& of_plugin(std::string_view name) { return of({.plugin = name}); }
  Words words() const { return {path, id, plugin, kind, is_local}; }
};

// One for each thread; see this_thread().
class CallMark {
 public:
  // Async-signal-safe.
  static constexpr std::uint32_t kBounded = 0x80;

  static CallMark& this_thread();

  // A call as another thread sees it: equal looks have seen the same call.
  struct Look {
    const CallSite* site = nullptr;  // outside of a call: of the last one
    std::uint32_t call = 0;          // a number of the call; the low byte is its function

    PluginFunction function() const { return static_cast<PluginFunction>(call & 0x7f); }
    bool is_bounded() const { return (call & kBounded) != 0; }
    friend bool operator==(const Look&, const Look&) = default;
  };

  void enter(const CallSite& site, PluginFunction function) {
    site_.store(&site, std::memory_order_release);
    serial_ += 1u << 8;
    call_.store(serial_ | static_cast<std::uint32_t>(function), std::memory_order_release);
  }
  void leave() {
    ForkGuard::check();
    call_.store(serial_, std::memory_order_release);
  }
  // The end of a call that may be within another one: a control node's child. `around` is what
  // `current` gave before.
  void leave(const Look& around) {
    leave();
    if (around.function() != PluginFunction::None) [[unlikely]]
      enter(*around.site, around.function());
  }
  // Other code ensures that this call returns in time.
  void set_bounded() {
    call_.store(call_.load(std::memory_order_relaxed) | kBounded, std::memory_order_release);
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
  // The same for the thread itself.
  Look current() const {
    return {site_.load(std::memory_order_relaxed), call_.load(std::memory_order_relaxed)};
  }
  std::uint64_t tick() const { return tick_.load(std::memory_order_relaxed); }
  static constexpr std::uint64_t kNoTick = ~std::uint64_t{0};  // before the first

 private:
  std::atomic<const CallSite*> site_{nullptr};
  std::atomic<std::uint32_t> call_{0};
  std::uint32_t serial_ = 0;
  std::atomic<pthread_t> worker_{0};
  std::atomic<std::uint64_t> tick_{kNoTick};
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
      : around_(CallMark::this_thread().look()) {
    CallMark::this_thread().enter(site, function);
  }
  ~MarkedCall() { CallMark::this_thread().leave(around_); }
  MarkedCall(const MarkedCall&) = delete;
  MarkedCall& operator=(const MarkedCall&) = delete;

 private:
  const CallMark::Look around_;
};

}  // namespace lockstep::host
