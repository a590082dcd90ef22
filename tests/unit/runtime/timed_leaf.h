// A plugin that is linked into the test, with one leaf type that runs for ever: each of its ticks
// calls `on_tick` of the test, which lets time pass or ends the run.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/tree.h"
#include "run/loading/plugin_set.h"

namespace lockstep::host::test {

struct TimedLeaves {
  // `leaves` of them under a Parallel.
  explicit TimedLeaves(std::uint32_t leaves);

  // Called in each tick of a leaf of this thread.
  static thread_local std::function<void(std::uint32_t leaf)> on_tick;
  // How many leaves were halted since the last of these was made.
  static thread_local std::uint32_t halted;
  // How many calls of pause and of resume there were, likewise.
  static thread_local std::uint32_t paused, resumed;

  PluginSet plugins;
  Tree tree;
};

}  // namespace lockstep::host::test
