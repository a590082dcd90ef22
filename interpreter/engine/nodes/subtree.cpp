#include "engine/nodes/decorator.h"

namespace lockstep::host {
namespace {

Status tick_subtree(NodeContext& context, NodeIndex self) {
  return context.tick(self + 1);
}

}  // namespace

// Its attributes (ID, remapping, _autoremap) are resolved before the tree is compiled.
const NodeKind kSubTree{.type = {.id = "SubTree",
                                 .category = NodeCategory::SubTree,
                                 .doc = "The tree with this ID, with a separate blackboard scope.",
                                 .begins_child_once = true},
                        .tick = tick_subtree,
                        .progress = decorator::child_progress};

}  // namespace lockstep::host
