// A leaf as the compiler would put it into a tree, for trees that are made without it.
#pragma once

#include "engine/nodes/kinds.h"
#include "engine/tree.h"

namespace lockstep::host::test {

inline Node leaf_node(const NodeKind& kind, NodeIndex node = 0) {
  return {.kind = &kind,
          .end = node + 1,
          .children = 0,
          .is_guard = 0,
          .is_latched = 0,
          .params = node,
          .state = 0};
}

}  // namespace lockstep::host::test
