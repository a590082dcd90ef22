#include "judge/measure/decision.h"

#include <algorithm>
#include <optional>

#include "engine/ticker.h"
#include "engine/tree.h"

namespace lockstep::host {
namespace {

// The last of several children that agree with their parent: for a Fallback, the one after which
// there was no other to try.
std::optional<NodeIndex> deciding_child(const std::vector<NodeIndex>& children, Status status,
                                        std::span<const NodeState> nodes) {
  const auto decides = [&](NodeIndex child) {
    const Status its = nodes[child].status();
    return nodes[child].ticked() && is_complete(its) && (children.size() == 1 || its == status);
  };
  const auto found = std::find_if(children.rbegin(), children.rend(), decides);
  return found == children.rend() ? std::nullopt : std::optional(*found);
}

}  // namespace

std::vector<DecidingNode> deciding_path(const Shape& shape, std::span<const NodeState> nodes) {
  std::vector<DecidingNode> path;
  for (std::optional<NodeIndex> node = 0; node;) {
    const Status status = nodes[*node].status();
    const std::vector<NodeIndex>& children = shape.nodes[*node].children;
    const auto agreeing = std::ranges::count_if(
        children, [&](NodeIndex child) { return nodes[child].status() == status; });
    path.push_back({.node = *node,
                    .status = status,
                    .children = children.size(),
                    .agreeing = static_cast<std::size_t>(agreeing)});
    node = deciding_child(children, status, nodes);
  }
  return path;
}

std::vector<DecidingNode> deciding_path(const Ticker& ticker) {
  std::vector<NodeState> nodes(ticker.tree().nodes.size());
  for (NodeIndex node = 0; node < nodes.size(); ++node) nodes[node] = ticker.node_state(node);
  return deciding_path(shape_of(ticker.tree()), nodes);
}

}  // namespace lockstep::host
