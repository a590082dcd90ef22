#include "engine/nodes/branches.h"

#include "dialect/btcpp/nodes/kinds.h"

namespace lockstep::host::btcpp {

const NodeKind kIfThenElse = branches::kIf<branches::Rule::Strict>;
const NodeKind kWhileDoElse = branches::kWhile<branches::Rule::Strict>;

}  // namespace lockstep::host::btcpp
