#include "engine/nodes/branches.h"

#include "engine/nodes/btcpp/kinds.h"

namespace lockstep::btcpp {

const NodeKind kIfThenElse = branches::kIf<branches::Rule::Strict>;
const NodeKind kWhileDoElse = branches::kWhile<branches::Rule::Strict>;

}  // namespace lockstep::btcpp
