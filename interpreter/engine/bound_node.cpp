#include "engine/bound_node.h"

#include <string>
#include <utility>

#include "engine/node_context.h"
#include "engine/tree.h"

namespace lockstep::host {

Status tick_bound(NodeContext& context, NodeIndex self) {
  if (!reread(context, self)) return give_up(context, self);
  return context.tree().bound_of(self).kind->tick(context, self);
}

bool reread(NodeContext& context, NodeIndex self) {
  std::string wrong = context.parameters().read(self);
  if (wrong.empty()) return true;
  context.set_fault(self, std::move(wrong));
  return false;
}

Status give_up(NodeContext& context, NodeIndex self) {
  if (context.faulted()) return Status::Running;
  context.halt_running_children(self);
  return Status::Failure;
}

}  // namespace lockstep::host
