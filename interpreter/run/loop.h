// The fixed-rate loop: ticks a run at absolute deadlines until it ends, with its observers around
// each tick. Deadlines are multiples of the period from the start, so there is no drift. An
// OverrunPolicy decides what happens to missed deadlines.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "base/core/clock.h"
#include "leaves/leaf_script.h"
#include "run/run.h"
#include "trace/observer.h"

namespace lockstep::host {

class CheckpointWriter;
class RunControl;
class StallFail;
class WatchedLeaves;

// Decides what happens to missed deadlines.
enum class OverrunPolicy : std::uint8_t {
  Skip,     // skipped: the next tick is at the next future deadline
  CatchUp,  // each gets its tick, one right after the other, until the run has caught up
  Fail,     // the run ends
};

// The default limit of ticks on the virtual clock.
constexpr std::uint64_t kMostVirtualTicks = 1'000'000;

struct LoopOptions {
  double rate = 100;                       // Hz, in [0.001, 100000]
  std::optional<std::uint64_t> max_ticks;  // stop after this many
  std::optional<Nanoseconds> timeout;      // stop before the first tick at or after this time; on a
                                           // real clock, time in which the run is paused counts too
  std::function<int()> stop_signal = {};   // called before each tick and in waits: nonzero = stop
  std::function<bool()> stopped = {};      // likewise: true = the program stops its run
  OverrunPolicy overrun = OverrunPolicy::Skip;
  Nanoseconds spin{0};  // on a real clock, the end of a wait that looks at the clock without sleep
  std::function<bool()> writing_failed = {};     // called before each tick: true = stop
  std::function<bool()> property_violated = {};  // likewise
  RunControl* control = nullptr;                 // who may pause the run, and more; or nobody
  StallFail* stall_fail = nullptr;               // who ends standstills, or nobody
  WatchedLeaves* watched_leaves = nullptr;       // compares them with a model; null: none
  CheckpointWriter* checkpoints = nullptr;       // who keeps the run, or nobody
  // The run goes on before these ticks, which rise, as if its process had been cut; then `cut` is
  // called. Only with leaves that may begin again without a halt: those of scripts.
  std::span<const ScriptCut> cuts = {};
  std::function<void(std::span<const CutLeaf> leaves)> cut = {};
  // Of a run that continues after a cut: what was before. The numbers of its ticks and its time
  // continue.
  struct Before {
    std::uint64_t ticks = 0;
    Nanoseconds time{0};                      // of the last one
    Nanoseconds gap{0};                       // since then, in which there was no process
    std::span<const std::uint32_t> set = {};  // entries that came from outside since then
  };
  Before before = {};
};

// Runs to the end: halts every running leaf and notifies every observer.
RunEnd run_loop(Run& run, Clock& clock, const LoopOptions& options,
                std::span<Observer* const> observers);

}  // namespace lockstep::host
