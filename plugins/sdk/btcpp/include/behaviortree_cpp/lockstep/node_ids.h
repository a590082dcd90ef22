// The nodes that every tree has. Generated from the rows of the language: ./dev generate.
#pragma once

#include <set>
#include <string>

namespace BT::lockstep_detail {

inline const std::set<std::string>& node_ids() {
  static const std::set<std::string> ids{"AlwaysFailure",
                                         "AlwaysSuccess",
                                         "AsyncFallback",
                                         "AsyncSequence",
                                         "Delay",
                                         "Fallback",
                                         "ForceFailure",
                                         "ForceSuccess",
                                         "IfThenElse",
                                         "InStep",
                                         "Inverter",
                                         "KeepRunningUntilFailure",
                                         "LoopBool",
                                         "LoopDouble",
                                         "LoopInt",
                                         "LoopString",
                                         "Parallel",
                                         "ParallelAll",
                                         "Precondition",
                                         "ReactiveFallback",
                                         "ReactiveSequence",
                                         "Repeat",
                                         "RetryUntilSuccessful",
                                         "RunOnce",
                                         "Script",
                                         "ScriptCondition",
                                         "Sequence",
                                         "SequenceWithMemory",
                                         "SetBlackboard",
                                         "SkipUnlessUpdated",
                                         "Sleep",
                                         "SubTree",
                                         "Switch2",
                                         "Switch3",
                                         "Switch4",
                                         "Switch5",
                                         "Switch6",
                                         "Timeout",
                                         "TryCatch",
                                         "UnsetBlackboard",
                                         "WaitValueUpdate",
                                         "WasEntryUpdated",
                                         "WhileDoElse"};
  return ids;
}

}  // namespace BT::lockstep_detail
