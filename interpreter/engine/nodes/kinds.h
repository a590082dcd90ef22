// The one table of built-in nodes. A row is defined in the file of its kind.
#pragma once

#include "engine/node_kind.h"

namespace lockstep {

extern const NodeKind kSequence, kFallback, kParallel, kParallelAbsolute, kParallelRelative;
extern const NodeKind kInverter, kForceSuccess, kForceFailure, kRepeat, kRetry, kTimeout, kDelay,
    kRunOnce, kKeepRunningUntilFailure, kSubTree;
extern const NodeKind kBarrier, kSyncProgress, kResources, kUseResources;
extern const NodeKind kAlwaysSuccess, kAlwaysFailure, kAlwaysRunning, kWait;

// In the order in which they are documented.
inline constexpr const NodeKind* kBuiltInKinds[] = {
    // Control nodes
    &kSequence, &kFallback, &kParallel, &kParallelAbsolute, &kParallelRelative,
    // Decorators
    &kInverter, &kForceSuccess, &kForceFailure, &kRepeat, &kRetry, &kTimeout, &kDelay, &kRunOnce,
    &kKeepRunningUntilFailure, &kSyncProgress, &kUseResources, &kSubTree,
    // Leaves
    &kAlwaysSuccess, &kAlwaysFailure, &kAlwaysRunning, &kWait,
    // Beside the trees
    &kBarrier, &kResources};

}  // namespace lockstep
