// A leaf or a run may get these from its host: time, random numbers, log lines. Also the boundary
// that turns C++ exceptions into leaf errors. Included by lockstep/leaf.hpp.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

#include "../ext/ticks.h"
#include "../leaf.h"

namespace lockstep {
inline namespace sdk1 {

enum class Status : std::int32_t {
  Running = LOCKSTEP_RUNNING,
  Success = LOCKSTEP_SUCCESS,
  Failure = LOCKSTEP_FAILURE,
  Skipped = LOCKSTEP_SKIPPED  // as if the node were not there in this tick
};

enum class LogLevel : std::int32_t {
  Debug = LOCKSTEP_LOG_DEBUG,
  Info = LOCKSTEP_LOG_INFO,
  Warning = LOCKSTEP_LOG_WARNING
};

namespace detail {

// Set in the thread of a ThreadedAction, from where nothing but log() may reach the host.
inline thread_local bool in_worker = false;

struct Caller {
  const lockstep_host* host = nullptr;
  const lockstep_caller* id = nullptr;
  void* run_context = nullptr;
  bool has_worker = false;

  void require_run_thread() const {
    if (has_worker && in_worker) {
      throw std::logic_error(
          "ports, time and random numbers belong to begin() and finish(), not run()");
    }
  }
};

// Runs `work`, in line; no exception leaves. `report` gets what it throws.
template <class Work, class Report>
[[gnu::always_inline]] inline void catching(Work&& work, Report&& report) noexcept {
  const auto tell = [&](const char* text) {
    report(text != nullptr ? text : "an exception without a text");
  };
  try {
    work();
  } catch (const std::exception& error) {
    tell(error.what());
  } catch (const char* message) {
    tell(message);
  } catch (const std::string& message) {
    report(message.c_str());
  } catch (...) {
    report("an exception that is not a std::exception");
  }
}

// A port that was read although it has no value.
class EmptyPort : public std::runtime_error {
 public:
  EmptyPort(std::uint32_t index, std::string_view name)
      : std::runtime_error("port '" + std::string(name) + "' has no value"), index_(index) {}
  std::uint32_t index() const { return index_; }

 private:
  std::uint32_t index_;
};

// The host knows why the port is empty; an older one gets the text.
inline bool tell_empty_port(const Caller& caller, std::uint32_t index) {
  constexpr std::size_t kEnd = offsetof(lockstep_host, set_empty_port) + sizeof(void*);
  if (caller.host->struct_size < kEnd) return false;
  caller.host->set_empty_port(caller.id, index);
  return true;
}

// Runs `work` and returns its result. An exception becomes an error of the caller, and `otherwise`
// the result, which then does not count.
template <class Result, class Work>
[[gnu::always_inline]] inline Result guarded(const Caller& caller, Result otherwise,
                                             Work&& work) noexcept {
  Result result = otherwise;
  const auto attempt = [&] {
    try {
      result = work();
    } catch (const EmptyPort& error) {
      if (!tell_empty_port(caller, error.index())) throw;
    }
  };
  catching(attempt, [&](const char* message) { caller.host->set_error(caller.id, message); });
  return result;
}

// The end of a run context: no run is left that an error could end, so this logs a warning.
template <class Work>
void guarded_end(const Caller& caller, Work&& work) noexcept {
  catching(work, [&](const char* message) {
    catching(
        [&] {
          const std::string line = std::string("its destructor threw: ") + message;
          caller.host->log(caller.id, LOCKSTEP_LOG_WARNING, line.c_str());
        },
        [](const char*) {});
  });
}

}  // namespace detail

// The host as one leaf, or one run, sees it.
class Services {
 public:
  // Seconds since the run began, the same for the whole of a tick.
  double now() const { return host().now(caller_.id); }
  // Seconds between two ticks.
  double tick_period() const { return host().tick_period(caller_.id); }
  // The number of the current tick. The next tick has the next number, also if it is late and
  // some were left out for it. An older host does not report it: the periods since the run began.
  std::uint64_t tick_number() const {
    const auto* const ticks = host_extension<lockstep_ticks>(LOCKSTEP_TICKS);
    if (ticks != nullptr) return ticks->number(caller_.id);
    return static_cast<std::uint64_t>(std::llround(now() / tick_period()));
  }

  // The language of the tree, by the attribute of its root: "lockstep" or "BTCPP_format". Empty
  // with an older host, and in a separate process.
  std::string_view language() const {
    constexpr std::size_t kSize =
        offsetof(lockstep_place, language) + sizeof(lockstep_place::language);
    const auto* const place = host_extension<lockstep_place>(LOCKSTEP_PLACE);
    const bool is_known = place != nullptr && place->struct_size >= kSize;
    const char* const attribute = is_known ? place->language(caller_.id) : nullptr;
    return attribute != nullptr ? attribute : "";
  }

  // The caller's own stream of random numbers: 64 bits, or uniform in [0, 1) or [low, high). The
  // same seed, tree and run give the same numbers.
  std::uint64_t random_bits() { return host().random_bits(caller_.id); }
  double random() { return host().random(caller_.id); }
  double uniform(double low, double high) { return low + (high - low) * random(); }

  // A line for the person that runs the tree; from any thread. To report that the leaf is broken,
  // throw.
  void log(LogLevel level, const std::string& message) const {
    caller_.host->log(caller_.id, static_cast<lockstep_log_level>(level), message.c_str());
  }
  void log(const std::string& message) const { log(LogLevel::Info, message); }

  // Why the result of this tick is what it is: what Action::fail and wait give. Nothing with an
  // older host.
  void say(const char* reason) const {
    const auto* const reasons = host_extension<lockstep_reason>(LOCKSTEP_REASON);
    if (reasons != nullptr) reasons->say(caller_.id, reason);
  }

  // A table of functions beyond leaf.h, or null when the host does not know the id.
  template <class Table>
  const Table* host_extension(const char* id) const {
    return static_cast<const Table*>(caller_.host->get_extension(id));
  }

  // The tree is ticked at once, by the program that waits for its next period; from any thread. In
  // a class with `static constexpr bool kWakes = true`. An older host ticks when the period is
  // over.
  void wake() const {
    constexpr std::size_t kSize = offsetof(lockstep_place, wake) + sizeof(lockstep_place::wake);
    const auto* const place = host_extension<lockstep_place>(LOCKSTEP_PLACE);
    if (place != nullptr && place->struct_size >= kSize) place->wake(caller_.id);
  }

  Services(const Services&) = delete;
  Services& operator=(const Services&) = delete;

 protected:
  explicit Services(const detail::Caller& caller) : caller_(caller) {}
  ~Services() = default;

  detail::Caller caller_;

 private:
  const lockstep_host& host() const {
    caller_.require_run_thread();
    return *caller_.host;
  }
};

}  // namespace sdk1
}  // namespace lockstep
