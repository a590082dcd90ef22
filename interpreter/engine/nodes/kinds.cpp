#include "engine/nodes/kinds.h"

namespace lockstep {

std::span<const NodeKind* const> built_in_kinds(Language language) {
  if (language == Language::BehaviorTreeCpp) return kBehaviorTreeCppKinds;
  return kBuiltInKinds;
}

}  // namespace lockstep
