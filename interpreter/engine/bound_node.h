// The tick of a built-in node with parameters from entries (Tree::bound): it reads them first. A
// value that the node does not accept is a fault of it.
#pragma once

#include "base/core/status.h"
#include "engine/node_kind.h"

namespace lockstep::host {

// Reads the entries, then ticks as the node's kind does.
Status tick_bound(NodeContext& context, NodeIndex self);
// Reads the entries of any node in the middle of its tick. False after a fault.
bool reread(NodeContext& context, NodeIndex self);
// The status that the node's tick returns after that.
Status give_up(NodeContext& context, NodeIndex self);

}  // namespace lockstep::host
