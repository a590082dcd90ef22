// What tree texts and documents of tests call scripted leaves.
#pragma once

#include "base/core/node_type.h"

namespace lockstep::host::test {

extern const NodeType kScriptedActionType;
extern const NodeType kScriptedConditionType;
extern const NodeType kBareActionType;        // an action that has no function but tick
extern const NodeType kWritingActionType;     // with outputs `out` and `flag`, which it never sets
extern const NodeType kWritingConditionType;  // likewise
extern const NodeType kStartlessActionType;   // an action that has no start

}  // namespace lockstep::host::test
