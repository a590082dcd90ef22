#include "dialect/btcpp/nodes/kinds.h"
#include "engine/nodes/check.h"

namespace lockstep::host::btcpp {

const NodeKind kScriptCondition = check::kind("ScriptCondition");

}  // namespace lockstep::host::btcpp
