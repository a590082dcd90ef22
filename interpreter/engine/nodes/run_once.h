// A decorator whose child completes once in a run.
#pragma once

#include "engine/node_context.h"

namespace lockstep::host::run_once {

// Not cleared by a new activation: once means once in a run.
struct State {
  Status result;  // Idle: not yet completed
};

inline Status tick(NodeContext& context, NodeIndex self) {
  State& state = context.state<State>(self);
  if (is_complete(state.result)) return state.result;
  const Status status = context.tick(self + 1);
  if (is_complete(status)) state.result = status;
  return status;
}

}  // namespace lockstep::host::run_once
