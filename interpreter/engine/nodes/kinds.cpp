#include "engine/nodes/kinds.h"

namespace lockstep {

std::span<const NodeKind* const> built_in_kinds() {
  return kBuiltInKinds;
}

}  // namespace lockstep
