#include "engine/ticker.h"

#include "engine/groups.h"
#include "engine/node_ports.h"
#include "engine/node_scripts.h"

namespace lockstep::host {

Status Ticker::tick_root(Nanoseconds now) {
  set_now(now);
  ++state_.tick_number;
  if (!held_leaves_.empty()) [[unlikely]]
    held_leaves_.look(*this);
  if (groups_.empty()) [[likely]]
    return tick(0);
  groups_.tick(*this);
  const Status result = tick(0);
  groups_.end_tick();
  return result;
}

Status Ticker::tick_root_again() {
  return tick(0);
}

void Ticker::halt_all() {
  state_.in_last_halt = true;
  halt_range(0, static_cast<NodeIndex>(tree_.nodes.size()));
  state_.in_last_halt = false;
}

void Ticker::reset() {
  state_.reset();
  parameters_.reset();
  ports_.names().reset();
  scripts_.reset();
  held_leaves_.reset();
  for (LeafSlot& leaf : leaves_) leaf.out_of_range = leaf.went_on = false;
}

}  // namespace lockstep::host
