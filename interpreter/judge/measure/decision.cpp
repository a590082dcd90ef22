#include "judge/measure/decision.h"

#include <algorithm>
#include <optional>

namespace lockstep::host {

DecidingNode deciding_node(const Shape& shape, const Moment& moment, NodeIndex node) {
  const std::vector<NodeIndex>& children = shape.nodes[node].children;
  const Status status = moment.status(node);
  const auto agreeing = std::ranges::count_if(
      children, [&](NodeIndex child) { return moment.status(child) == status; });
  return {.node = node,
          .status = status,
          .children = children.size(),
          .agreeing = static_cast<std::size_t>(agreeing)};
}

// The last of several children that agree with their parent: for a Fallback, the one after which
// there was no other to try.
std::optional<NodeIndex> deciding_child(const Shape& shape, const Moment& moment, NodeIndex node) {
  const std::vector<NodeIndex>& children = shape.nodes[node].children;
  const Status status = moment.status(node);
  if (!is_complete(status)) return std::nullopt;
  const auto decides = [&](NodeIndex child) {
    const Status its = moment.status(child);
    return moment.ticked(child) && is_complete(its) && (children.size() == 1 || its == status);
  };
  const auto found = std::find_if(children.rbegin(), children.rend(), decides);
  return found == children.rend() ? std::nullopt : std::optional(*found);
}

std::vector<DecidingNode> deciding_path(const Shape& shape, const Moment& moment) {
  std::vector<DecidingNode> path;
  for (std::optional<NodeIndex> node = 0; node; node = deciding_child(shape, moment, *node)) {
    path.push_back(deciding_node(shape, moment, *node));
  }
  return path;
}

}  // namespace lockstep::host
