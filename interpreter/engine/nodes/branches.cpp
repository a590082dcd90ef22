#include "engine/nodes/branches.h"

#include "engine/nodes/kinds.h"

namespace lockstep::host {

const NodeKind kIfThenElse = branches::kIf<branches::Rule::Plain>;
const NodeKind kWhileDoElse = branches::kWhile<branches::Rule::Plain>;

}  // namespace lockstep::host
