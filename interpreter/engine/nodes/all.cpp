// The one table of built-in nodes, in the order in which they are documented.
#include "engine/nodes/kinds.h"

namespace lockstep {

std::span<const NodeKind* const> built_in_kinds() {
  static constexpr const NodeKind* kAll[] = {
      &kSequence,
      &kFallback,
      &kParallel,
      &kParallelAbsolute,
      &kParallelRelative,
      &kInverter,
      &kForceSuccess,
      &kForceFailure,
      &kRepeat,
      &kRetry,
      &kTimeout,
      &kDelay,
      &kRunOnce,
      &kKeepRunningUntilFailure,
      &kSubTree,
      &kAlwaysSuccess,
      &kAlwaysFailure,
      &kAlwaysRunning,
      &kWait,
  };
  return kAll;
}

}  // namespace lockstep
