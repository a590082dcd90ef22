// Whether a node that is Success, Failure or Skipped has become so in a tick, or stands as it was.
#pragma once

#include "trace/node_state.h"

namespace lockstep::host {

// `before` and `now`: after two ticks, or two moments of one, in a row. A status stays until the
// node is reached again, so it may be the same result of another activation. A node that completes
// in each tick, as a guard does, completes newly in the first one only.
constexpr bool completes_newly(NodeState before, NodeState now) {
  if (!now.ticked() || !has_ended(now.status())) return false;
  return now.status() != before.status() || !before.ticked();
}

}  // namespace lockstep::host
