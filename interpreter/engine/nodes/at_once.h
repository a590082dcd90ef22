// Shared by the leaves that complete at once, and AlwaysRunning.
#pragma once

#include "engine/node_context.h"

namespace lockstep::host {

inline double no_progress(NodeContext&, NodeIndex) {
  return 0.0;
}

}  // namespace lockstep::host
