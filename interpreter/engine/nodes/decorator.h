// Shared by the decorators. A decorator has one child, at self + 1.
#pragma once

#include "engine/node_context.h"
#include "engine/nodes/kinds.h"

namespace lockstep::host::decorator {

inline double child_progress(NodeContext& context, NodeIndex self) {
  return context.progress(self + 1);
}

}  // namespace lockstep::host::decorator
