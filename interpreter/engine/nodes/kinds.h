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

// Of trees for BehaviorTree.CPP. A kind that means the same is in both lists.
inline constexpr const NodeKind* kBehaviorTreeCppKinds[] = {
    // Control nodes
    &kParallelAbsolute, &kParallelRelative,
    // Decorators
    &kInverter, &kForceSuccess, &kForceFailure, &kSubTree,
    // Leaves
    &kAlwaysSuccess, &kAlwaysFailure};

}  // namespace lockstep
