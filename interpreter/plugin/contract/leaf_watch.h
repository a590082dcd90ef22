// Watches the calls of the leaves of one run: marks them (call_mark.h), times them, and restores
// the rounding mode if a leaf changes it. The watch is a separate leaf type between the engine and
// a leaf's functions, so a run without a watch has no cost.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "engine/leaf_slot.h"
#include "engine/tree.h"
#include "plugin/contract/call_mark.h"

namespace lockstep::host {

struct LeafWatchOptions {
  // A longer call is reported to on_slow, at most once a second for all leaves. None: calls are not
  // timed.
  std::optional<Nanoseconds> budget;
  Clock* clock = nullptr;  // that times the calls; null: a CycleClock
  // All on the tick thread, after the call.
  std::function<void(NodeIndex leaf, PluginFunction function, Nanoseconds took)> on_slow = {};
  // The values of the leaf's ports took that long on their way between processes: longer than the
  // budget. Not a part of what the leaf took; reported as that is.
  std::function<void(NodeIndex leaf, Nanoseconds took)> on_carried = {};
  // The leaf has changed the rounding mode or the floating-point exceptions; reported once per
  // leaf.
  std::function<void(NodeIndex leaf, PluginFunction function)> on_float_mode = {};
};

class LeafWatch {
 public:
  explicit LeafWatch(LeafWatchOptions options);
  ~LeafWatch();
  LeafWatch(const LeafWatch&) = delete;
  LeafWatch& operator=(const LeafWatch&) = delete;

  // For LeafSet. Puts itself in front of every leaf of `slots`, which have been created; `remove`
  // undoes it, and does nothing when it was not there. `sites` has one for each slot. The mode of
  // floating-point that leaves must keep is the one of now. Always the same tree.
  void insert(const Tree& tree, std::span<LeafSlot> slots, std::span<const CallSite* const> sites);
  void remove(std::span<LeafSlot> slots);

  // For the owner of the run, before a tick of the root, by its number from 0.
  void begin_tick(std::uint64_t tick);

  struct Slowest {
    NodeIndex leaf = 0;
    PluginFunction function = PluginFunction::None;
    Nanoseconds took{0};
  };
  // The longest call since begin_tick; its function is None when none was timed.
  Slowest slowest() const;

  // The statistics of a leaf that exceeded its budget at least once, in all runs of this watch.
  struct Timing {
    NodeIndex leaf = 0;
    std::uint64_t ticks = 0;        // calls of tick
    std::uint64_t over_budget = 0;  // calls of any function that took longer
    Nanoseconds p50{0}, p99{0};     // of tick, at most a sixteenth too large
    Nanoseconds max{0};             // of any function, exact
  };
  // The leaves that were over their budget, the one with the longest call first.
  std::vector<Timing> over_budget() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

}  // namespace lockstep::host
