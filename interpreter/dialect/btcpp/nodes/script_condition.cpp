#include "dialect/btcpp/nodes/kinds.h"
#include "engine/nodes/check.h"

namespace lockstep::btcpp {

const NodeKind kScriptCondition = check::kind("ScriptCondition");

}  // namespace lockstep::btcpp
