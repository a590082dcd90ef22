// The built-in nodes of BehaviorTree.CPP.
#pragma once

#include "engine/nodes/kinds.h"

namespace lockstep::host::btcpp {

extern const NodeKind kSequence, kFallback, kReactiveSequence, kReactiveFallback, kAsyncSequence,
    kAsyncFallback, kSequenceWithMemory, kParallel, kParallelAll, kIfThenElse, kWhileDoElse,
    kSwitch2, kSwitch3, kSwitch4, kSwitch5, kSwitch6, kTryCatch;
extern const NodeKind kRepeat, kRetryUntilSuccessful, kRunOnce, kDelay, kTimeout, kPrecondition,
    kSkipUnlessUpdated, kWaitValueUpdate, kLoopInt, kLoopBool, kLoopDouble, kLoopString;
extern const NodeKind kSleep, kScriptCondition, kSetBlackboard, kUnsetBlackboard, kWasEntryUpdated;

// In the order in which they are documented. A kind that means the same is that of our language.
inline constexpr const NodeKind* kKinds[] = {
    // Control nodes
    &kSequence, &kFallback, &kReactiveSequence, &kReactiveFallback, &kAsyncSequence,
    &kAsyncFallback, &kSequenceWithMemory, &kParallel, &kParallelAll, &kIfThenElse, &kWhileDoElse,
    &kSwitch2, &kSwitch3, &kSwitch4, &kSwitch5, &kSwitch6, &kTryCatch,
    &lockstep::host::kParallelAbsolute, &lockstep::host::kParallelRelative,
    // Decorators
    &lockstep::host::kInverter, &lockstep::host::kForceSuccess, &lockstep::host::kForceFailure,
    &kRepeat, &kRetryUntilSuccessful, &lockstep::host::kKeepRunningUntilFailure, &kRunOnce, &kDelay,
    &kTimeout, &kPrecondition, &kSkipUnlessUpdated, &kWaitValueUpdate, &kLoopInt, &kLoopBool,
    &kLoopDouble, &kLoopString, &lockstep::host::kSyncProgress, &lockstep::host::kUseResources,
    &lockstep::host::kInStep, &lockstep::host::kSubTree,
    // Leaves
    &lockstep::host::kAlwaysSuccess, &lockstep::host::kAlwaysFailure, &kSleep,
    &lockstep::host::kScript, &kScriptCondition, &kSetBlackboard, &kUnsetBlackboard,
    &kWasEntryUpdated, &lockstep::host::kWaitUntil,
    // Beside the trees
    &lockstep::host::kBarrier, &lockstep::host::kResources, &lockstep::host::kTeam};

}  // namespace lockstep::host::btcpp
