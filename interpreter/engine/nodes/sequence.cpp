#include "engine/nodes/kinds.h"
#include "engine/nodes/ordered.h"

namespace lockstep {
namespace {

double progress(Ticker& ticker, NodeIndex self) {
  const auto& state = ticker.state<ordered::State>(self);
  return (state.done + ticker.progress(state.current)) / ticker.node(self).children;
}

}  // namespace

const NodeKind kSequence{
    .type = {.id = "Sequence",
             .category = NodeCategory::Control,
             .doc = "Ticks its children from the left, every tick from the first; stops at the "
                    "first that is Running or Failure and returns that. Success when all succeed.",
             .arity = {1},
             .parameters = ordered::kParameters,
             .sign = "→",
             .goes_on_after = Status::Success},
    .tick = ordered::tick<Status::Success>,
    .progress = progress,
    .state_size = sizeof(ordered::State)};

}  // namespace lockstep
