// How the states of node kinds are folded (NodeKind::fold): bytes that no later tick reads are 0,
// and times are relative to now. tests/property/fold_test.cpp walks runs that are folded after each
// tick beside runs that are not.
#pragma once

#include <cstring>

#include "engine/node_context.h"

namespace lockstep::host::fold {

// Each tick writes it before it reads it.
inline void dead(NodeContext& context, NodeIndex self) {
  const std::span<std::byte> bytes = context.kept_bytes(self);
  std::memset(bytes.data(), 0, bytes.size());
}

// The first tick of an activation writes it.
inline void dead_when_idle(NodeContext& context, NodeIndex self) {
  if (context.status(self) != Status::Running) dead(context, self);
}

// It says something as it is, at any time.
inline void live(NodeContext& /*context*/, NodeIndex /*self*/) {}

}  // namespace lockstep::host::fold
