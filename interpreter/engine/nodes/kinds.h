// The built-in nodes of lockstep's own language. A row is defined in the file of its kind.
#pragma once

#include "engine/node_kind.h"

namespace lockstep::host {

extern const NodeKind kSequence, kFallback, kParallel, kParallelAbsolute, kParallelRelative,
    kIfThenElse, kWhileDoElse, kSwitch;
extern const NodeKind kInverter, kForceSuccess, kForceFailure, kRepeat, kRetry, kTimeout, kDelay,
    kCooldown, kRate, kRunOnce, kKeepRunningUntilFailure, kSubTree;
extern const NodeKind kBarrier, kSyncProgress, kResources, kUseResources, kTeam, kInStep;
extern const NodeKind kAlwaysSuccess, kAlwaysFailure, kAlwaysRunning, kWait, kWaitUntil, kAsk,
    kScript, kCheck;

// In the order in which they are documented.
inline constexpr const NodeKind* kBuiltInKinds[] = {
    // Control nodes
    &kSequence, &kFallback, &kParallel, &kParallelAbsolute, &kParallelRelative, &kIfThenElse,
    &kWhileDoElse, &kSwitch, &kInStep,
    // Decorators
    &kInverter, &kForceSuccess, &kForceFailure, &kRepeat, &kRetry, &kTimeout, &kDelay, &kCooldown,
    &kRate, &kRunOnce, &kKeepRunningUntilFailure, &kSyncProgress, &kUseResources, &kSubTree,
    // Leaves
    &kAlwaysSuccess, &kAlwaysFailure, &kAlwaysRunning, &kWait, &kWaitUntil, &kAsk, &kScript,
    &kCheck,
    // Beside the trees
    &kBarrier, &kResources, &kTeam};

}  // namespace lockstep::host
