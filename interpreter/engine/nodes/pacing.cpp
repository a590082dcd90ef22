#include "engine/nodes/pacing.h"

#include "engine/tree.h"

namespace lockstep::host::pacing {

double taken_up(NodeContext& context, NodeIndex node) {
  constexpr double kNobody = std::numeric_limits<double>::infinity();
  if (context.status(node) != Status::Running) return kNobody;
  const NodeKind& kind = *context.tree().nodes[node].kind;
  if (kind.taken_up != nullptr) return kind.taken_up(context, node);
  if (context.end_of(node) == node + 1) return 1.0;
  // A member only hands on the larger of two factors.
  const bool asks = kind.paced_child != nullptr && context.node(node).synchronizes != 0;
  double least = kNobody;
  std::uint32_t place = 0;
  for (NodeIndex child = node + 1; child != context.end_of(node); child = context.end_of(child)) {
    double taken = taken_up(context, child);
    if (asks) taken /= kind.paced_child(context, node, place)->told;
    ++place;
    least = std::min(least, taken);
  }
  return least;
}

}  // namespace lockstep::host::pacing
