#include "embedding/run_limits.h"

#include <utility>

#include "engine/tree.h"
#include "trace/progress_text.h"

namespace lockstep::host::embedding {

RunLimitsWatch::RunLimitsWatch(RunLimits limits, const Tree& tree, const LeafLog& log)
    : limits_(std::move(limits)) {
  if (!limits_.budget) return;
  LeafWatchOptions options{.budget = limits_.budget};
  options.on_slow = [&tree, log, budget = *limits_.budget](NodeIndex leaf, PluginFunction function,
                                                           Nanoseconds took) {
    log(tree.path(leaf), LOCKSTEP_LOG_WARNING, over_budget_text(function, took, budget));
  };
  leaves_.emplace(std::move(options));
}

void RunLimitsWatch::begin() {
  watchdog_.reset();
  WatchdogOptions options{.hang_limit = limits_.hang_limit};
  options.handles_signals = false;
  options.on_hang = [this](const CallMark::Look& call, Nanoseconds lasts) {
    limits_.on_hang(call.site == nullptr ? "a plugin" : call.site->text(), name_of(call.function),
                    to_seconds(lasts));
  };
  watchdog_.emplace(std::move(options));
  thread_ = this_thread_id();
}

}  // namespace lockstep::host::embedding
