// The rows of the built-in table, one for each node kind; all.cpp puts them in order.
#pragma once

#include "engine/node_kind.h"

namespace lockstep {

extern const NodeKind kSequence, kFallback, kParallel, kParallelAbsolute, kParallelRelative;
extern const NodeKind kInverter, kForceSuccess, kForceFailure, kRepeat, kRetry, kTimeout, kDelay,
    kRunOnce, kKeepRunningUntilFailure, kSubTree;
extern const NodeKind kAlwaysSuccess, kAlwaysFailure, kAlwaysRunning, kWait;

}  // namespace lockstep
