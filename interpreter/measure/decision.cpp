#include "measure/decision.h"

#include <algorithm>
#include <optional>

#include "engine/ticker.h"
#include "measure/synchronized_measure.h"

namespace lockstep::host {
namespace {

// The last of several children that agree with their parent: for a Fallback, the one after which
// there was no other to try.
std::optional<NodeIndex> deciding_child(const TickedTree& tree, Status status,
                                        const std::vector<NodeIndex>& children) {
  const auto decides = [&](NodeIndex child) {
    const Status its = tree.status(child);
    return tree.ticked(child) && is_complete(its) && (children.size() == 1 || its == status);
  };
  const auto found = std::find_if(children.rbegin(), children.rend(), decides);
  return found == children.rend() ? std::nullopt : std::optional(*found);
}

}  // namespace

std::vector<DecidingNode> deciding_path(const TickedTree& tree) {
  std::vector<DecidingNode> path;
  for (std::optional<NodeIndex> node = 0; node;) {
    const Status status = tree.status(*node);
    const std::vector<NodeIndex> children = tree.children(*node);
    const auto agreeing = std::ranges::count(children, status, tree.status);
    path.push_back({.node = *node,
                    .status = status,
                    .children = children.size(),
                    .agreeing = static_cast<std::size_t>(agreeing)});
    node = deciding_child(tree, status, children);
  }
  return path;
}

std::vector<DecidingNode> deciding_path(const Ticker& ticker) {
  return deciding_path({
      .children = [&](NodeIndex node) { return children_of(ticker.tree(), node); },
      .status = [&](NodeIndex node) { return ticker.status(node); },
      .ticked = [&](NodeIndex node) { return ticker.ticked(node); },
  });
}

}  // namespace lockstep::host
