// How long calls of leaves may last, and who is told when they do not return. Only within
// embedding/.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "engine/leaf_watch.h"
#include "leaves/plugin/contract/leaf_set.h"
#include "run/watchdog.h"

namespace lockstep::host::embedding {

struct RunLimits {
  std::optional<Nanoseconds> budget = {};  // of a call
  Nanoseconds hang_limit{0};               // 0: none
  std::function<void(const std::string& who, const char* function, double seconds)> on_hang = {};
};

class RunLimitsWatch {
 public:
  RunLimitsWatch(RunLimits limits, const Tree& tree, const LeafLog& log);

  // Null: calls are not timed.
  LeafWatch* leaf_watch() { return leaves_ ? &*leaves_ : nullptr; }
  // Watches the calling thread, which ticks from now on.
  void watch_this_thread() {
    if (limits_.on_hang && limits_.hang_limit > Nanoseconds(0) && thread_ != this_thread_id())
      begin();
  }

 private:
  void begin();

  const RunLimits limits_;
  std::optional<LeafWatch> leaves_;
  std::optional<Watchdog> watchdog_;
  const void* thread_ = nullptr;  // whose calls it watches
};

}  // namespace lockstep::host::embedding
