// The one table of built-in nodes. A row is defined in the file of its kind.
#pragma once

#include "engine/node_kind.h"

namespace lockstep {

extern const NodeKind kSequence, kFallback, kParallel, kParallelAbsolute, kParallelRelative,
    kIfThenElse, kWhileDoElse, kSwitch;
extern const NodeKind kInverter, kForceSuccess, kForceFailure, kRepeat, kRetry, kTimeout, kDelay,
    kCooldown, kRate, kRunOnce, kKeepRunningUntilFailure, kSubTree;
extern const NodeKind kBarrier, kSyncProgress, kResources, kUseResources;
extern const NodeKind kAlwaysSuccess, kAlwaysFailure, kAlwaysRunning, kWait, kScript, kCheck;

// In the order in which they are documented.
inline constexpr const NodeKind* kBuiltInKinds[] = {
    // Control nodes
    &kSequence, &kFallback, &kParallel, &kParallelAbsolute, &kParallelRelative, &kIfThenElse,
    &kWhileDoElse, &kSwitch,
    // Decorators
    &kInverter, &kForceSuccess, &kForceFailure, &kRepeat, &kRetry, &kTimeout, &kDelay, &kCooldown,
    &kRate, &kRunOnce, &kKeepRunningUntilFailure, &kSyncProgress, &kUseResources, &kSubTree,
    // Leaves
    &kAlwaysSuccess, &kAlwaysFailure, &kAlwaysRunning, &kWait, &kScript, &kCheck,
    // Beside the trees
    &kBarrier, &kResources};

namespace btcpp {
extern const NodeKind kSequence, kFallback, kReactiveSequence, kReactiveFallback, kAsyncSequence,
    kAsyncFallback, kSequenceWithMemory, kParallel, kParallelAll, kIfThenElse, kWhileDoElse,
    kSwitch2, kSwitch3, kSwitch4, kSwitch5, kSwitch6, kTryCatch;
extern const NodeKind kRepeat, kRetryUntilSuccessful, kRunOnce, kDelay, kTimeout, kPrecondition,
    kSkipUnlessUpdated, kWaitValueUpdate, kLoopInt, kLoopBool, kLoopDouble, kLoopString;
extern const NodeKind kSleep, kScriptCondition, kSetBlackboard, kUnsetBlackboard, kWasEntryUpdated;
}  // namespace btcpp

// Of trees for BehaviorTree.CPP. A kind that means the same is in both lists.
inline constexpr const NodeKind* kBehaviorTreeCppKinds[] = {
    // Control nodes
    &btcpp::kSequence, &btcpp::kFallback, &btcpp::kReactiveSequence, &btcpp::kReactiveFallback,
    &btcpp::kAsyncSequence, &btcpp::kAsyncFallback, &btcpp::kSequenceWithMemory, &btcpp::kParallel,
    &btcpp::kParallelAll, &btcpp::kIfThenElse, &btcpp::kWhileDoElse, &btcpp::kSwitch2,
    &btcpp::kSwitch3, &btcpp::kSwitch4, &btcpp::kSwitch5, &btcpp::kSwitch6, &btcpp::kTryCatch,
    &kParallelAbsolute, &kParallelRelative,
    // Decorators
    &kInverter, &kForceSuccess, &kForceFailure, &btcpp::kRepeat, &btcpp::kRetryUntilSuccessful,
    &kKeepRunningUntilFailure, &btcpp::kRunOnce, &btcpp::kDelay, &btcpp::kTimeout,
    &btcpp::kPrecondition, &btcpp::kSkipUnlessUpdated, &btcpp::kWaitValueUpdate, &btcpp::kLoopInt,
    &btcpp::kLoopBool, &btcpp::kLoopDouble, &btcpp::kLoopString, &kSubTree,
    // Leaves
    &kAlwaysSuccess, &kAlwaysFailure, &btcpp::kSleep, &kScript, &btcpp::kScriptCondition,
    &btcpp::kSetBlackboard, &btcpp::kUnsetBlackboard, &btcpp::kWasEntryUpdated};

}  // namespace lockstep
