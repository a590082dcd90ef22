// The fixed-rate loop: ticks a run at absolute deadlines until it ends, with its observers around
// each tick. Deadlines are multiples of the period from the start, so there is no drift; those that
// a late tick has missed are dealt with by an OverrunPolicy.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "core/clock.h"
#include "runtime/deadlines.h"
#include "runtime/observer.h"
#include "runtime/run.h"

namespace lockstep {

// What becomes of deadlines that a late tick has missed.
enum class OverrunPolicy : std::uint8_t {
  Skip,     // passed over: the next tick is at the next deadline to come
  CatchUp,  // each still gets its tick, one right after the other, until the run is back in time
  Fail,     // the run ends
};

// Of a run on the virtual clock, if nobody says how many.
constexpr std::uint64_t kMostVirtualTicks = 1'000'000;

struct LoopOptions {
  double rate = 100;                       // Hz, in [0.001, 100000]
  std::optional<std::uint64_t> max_ticks;  // stop after this many
  std::optional<Nanoseconds> timeout;      // stop before the first tick at or after this time
  int (*stop_signal)() = nullptr;          // asked before each tick: nonzero = stop
  OverrunPolicy overrun = OverrunPolicy::Skip;
  std::function<bool()> recording_failed = {};  // asked before each tick: true = stop
};

// Runs to the end: every running leaf is halted, every observer has heard of it.
RunEnd run_loop(Run& run, Clock& clock, const LoopOptions& options,
                std::span<Observer* const> observers);

}  // namespace lockstep
