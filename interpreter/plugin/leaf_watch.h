// Watches the calls into the leaves of one run: marks them (call_mark.h), times them, and sets back
// the rounding mode when a leaf changes it. A run without a watch pays nothing: the watch puts
// itself between the engine and a leaf's functions, as a leaf type of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/clock.h"
#include "engine/leaf_slot.h"
#include "engine/tree.h"
#include "plugin/call_mark.h"

namespace lockstep {

struct LeafWatchOptions {
  // A call that takes longer is told to on_slow, at most once a second for all leaves. None: calls
  // are not timed.
  std::optional<Nanoseconds> budget;
  // Both on the tick thread, after the call.
  std::function<void(NodeIndex leaf, PluginFunction function, Nanoseconds took)> on_slow;
  // The leaf has changed the rounding mode or the floating-point exceptions; told once per leaf.
  std::function<void(NodeIndex leaf, PluginFunction function)> on_float_mode;
};

class LeafWatch {
 public:
  explicit LeafWatch(LeafWatchOptions options);
  ~LeafWatch();
  LeafWatch(const LeafWatch&) = delete;
  LeafWatch& operator=(const LeafWatch&) = delete;

  // For LeafSet. Puts itself in front of every created leaf of `slots`; `remove` undoes it.
  void insert(const Tree& tree, std::span<LeafSlot> slots);
  void remove(std::span<LeafSlot> slots);

  // For the owner of the run, around a tick of the root.
  void begin_tick(std::uint64_t tick);

  struct Slowest {
    NodeIndex leaf = 0;
    PluginFunction function = PluginFunction::None;
    Nanoseconds took{0};  // 0: no call was timed
  };
  // The longest call since begin_tick.
  Slowest slowest() const;

  // What is known of a leaf that was over its budget at least once.
  struct Timing {
    NodeIndex leaf = 0;
    std::uint64_t calls = 0;        // of tick
    std::uint64_t over_budget = 0;  // of these
    Nanoseconds p50{0}, p99{0}, max{0};
  };
  // Of the leaves that were over their budget, the worst first.
  std::vector<Timing> over_budget() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

}  // namespace lockstep
