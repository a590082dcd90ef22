#include "engine/bound_node.h"

#include <string>
#include <utility>

#include "engine/node_context.h"
#include "engine/tree.h"

namespace lockstep::host {

namespace {

// False after a fault.
bool accept(NodeContext& context, NodeIndex self, std::string wrong) {
  if (wrong.empty()) [[likely]]
    return true;
  context.set_fault(self, std::move(wrong));
  return false;
}

}  // namespace

Status tick_bound(NodeContext& context, NodeIndex self) {
  const std::uint32_t place = context.tree().place_in_front(self, FrontCell::Bound);
  if (!accept(context, self, context.parameters().read_bound(place))) return give_up(context, self);
  return context.tree().bound[place].kind->tick(context, self);
}

bool reread(NodeContext& context, NodeIndex self) {
  return accept(context, self, context.parameters().read(self));
}

Status give_up(NodeContext& context, NodeIndex self) {
  if (context.faulted()) return Status::Running;
  context.halt_running_children(self);
  return Status::Failure;
}

}  // namespace lockstep::host
