#include "engine/nodes/btcpp/kinds.h"
#include "engine/nodes/check.h"

namespace lockstep::btcpp {

const NodeKind kScriptCondition = check::kind("ScriptCondition");

}  // namespace lockstep::btcpp
