#include "engine/held_leaves.h"

#include <algorithm>

#include "engine/node_context.h"
#include "engine/synchronized.h"

namespace lockstep::host {
namespace {

// A smaller rise is noise: of a sensor, or of an arm that slows down.
constexpr double kMuch = 0.01;
// One rise may be the answer to the last tick, which came late.
constexpr std::uint32_t kRises = 2;

}  // namespace

void HeldLeaves::add(NodeContext& context, NodeIndex node) {
  const LeafSlot& leaf = context.leaf(node);
  if (leaf.went_on || leaf.is_out()) return;
  if (const auto now = look_at_progress(context, node)) held_.push_back({node, 0, *now, *now});
}

void HeldLeaves::look(NodeContext& context) {
  std::erase_if(held_, [&](Held& held) { return is_done(context, held); });
}

// Nothing more is to be found.
bool HeldLeaves::is_done(NodeContext& context, Held& held) {
  LeafSlot& leaf = context.leaf(held.node);
  if (leaf.failed()) return context.status(held.node) != Status::Running;  // see last_progress
  if (!context.held(held.node) || leaf.went_on) return true;
  // Without a share: a call of the tick finds the fault, and last_progress looks here then.
  const auto now = look_at_progress(context, held.node);
  if (!now || *now <= held.most + kProgressEpsilon) return false;
  held.most = *now;
  if (++held.rises < kRises || *now < held.from + kMuch) return false;
  leaf.went_on = true;
  went_on_.push_back({held.node, held.from, *now});
  return true;
}

void HeldLeaves::reset() {
  held_.clear();
  went_on_.clear();
}

}  // namespace lockstep::host
