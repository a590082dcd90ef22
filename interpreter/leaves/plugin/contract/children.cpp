// The functions with which a control node or decorator of a plugin uses its children:
// lockstep_children. Each breach of the contract is an error of the node, which ends its call as
// set_error does.
#include <fmt/format.h>

#include "engine/node_context.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

void breach(const lockstep_caller* caller, std::string_view what) {
  take_error(*caller, Shortened(what));
}

// True if the node may use its children in this way now.
bool may(const lockstep_caller* caller, ChildAccess access, std::string_view what) {
  if (caller->is_foreign()) return false;
  const LeafSlot& slot = *caller->slot;
  if (slot.access >= access) [[likely]]
    return slot.error == nullptr && !slot.failed() && !caller->run->node_context->faulted();
  if (caller->children == 0) {
    breach(caller, fmt::format("{} a child, but has none", what));
  } else if (access == ChildAccess::Tick) {
    breach(caller, fmt::format("{} a child outside of its tick", what));
  } else {
    breach(caller, fmt::format("{} a child while it was not called by the host", what));
  }
  return false;
}

// And it has this child.
bool may(const lockstep_caller* caller, ChildAccess access, std::string_view what,
         std::uint32_t child) {
  if (!may(caller, access, what)) return false;
  const std::uint32_t count = caller->children;
  if (child < count) [[likely]]
    return true;
  breach(caller, fmt::format("{} child {}, but has {} {}, counted from 0", what, child, count,
                             count == 1 ? "child" : "children"));
  return false;
}

std::uint32_t count(const lockstep_caller* caller) {
  return caller->is_foreign() ? 0 : caller->children;
}

// Ticks a child in the way that `function` does.
template <class Function>
lockstep_status tick_by(const lockstep_caller* caller, std::uint32_t child, Function function) {
  if (!may(caller, ChildAccess::Tick, "ticks", child)) return LOCKSTEP_RUNNING;
  LeafSlot& slot = *caller->slot;
  const NodeIndex node = caller->child(child);
  NodeContext& context = *caller->run->node_context;
  if (context.ticked_so_far(node)) [[unlikely]] {
    if (!context.tree().rules->may_tick_again) {
      breach(caller, fmt::format("ticks child {} twice in one tick", child));
      return LOCKSTEP_RUNNING;
    }
    if (context.ticked(node)) context.begin_again(node);
  } else if (context.was_halted(node)) {
    context.begin_again(node);
  }
  // Code of the child that knows this caller must not use it.
  slot.access = ChildAccess::None;
  const InEngine scope(caller->run->lock);
  const Status status = function(context, node);
  slot.access = ChildAccess::Tick;
  return static_cast<lockstep_status>(status);
}

lockstep_status tick(const lockstep_caller* caller, std::uint32_t child) {
  return tick_by(caller, child,
                 [](NodeContext& context, NodeIndex node) { return context.tick(node); });
}

lockstep_status tick_unreset(const lockstep_caller* caller, std::uint32_t child) {
  return tick_by(caller, child, [](NodeContext& context, NodeIndex node) {
    const Status before = context.status(node);
    const bool has_completed = before == Status::Success || before == Status::Failure;
    return has_completed ? context.tick_unreset(node) : context.tick(node);
  });
}

void halt(const lockstep_caller* caller, std::uint32_t child) {
  if (!may(caller, ChildAccess::Tick, "halts", child)) return;
  LeafSlot& slot = *caller->slot;
  slot.access = ChildAccess::None;
  const InEngine scope(caller->run->lock);
  caller->run->node_context->halt(caller->child(child));
  slot.access = ChildAccess::Tick;
}

void pause(const lockstep_caller* caller, std::uint32_t child) {
  if (!may(caller, ChildAccess::Tick, "pauses", child)) return;
  LeafSlot& slot = *caller->slot;
  slot.access = ChildAccess::None;
  const InEngine scope(caller->run->lock);
  caller->run->node_context->pause(caller->child(child));
  slot.access = ChildAccess::Tick;
}

lockstep_status status(const lockstep_caller* caller, std::uint32_t child) {
  if (!may(caller, ChildAccess::Look, "requests", child)) return LOCKSTEP_RUNNING;
  return static_cast<lockstep_status>(caller->run->node_context->status(caller->child(child)));
}

double progress(const lockstep_caller* caller, std::uint32_t child) {
  if (!may(caller, ChildAccess::Look, "requests", child)) return 0;
  LeafSlot& slot = *caller->slot;
  const ChildAccess access = std::exchange(slot.access, ChildAccess::None);
  const InEngine scope(caller->run->lock);
  const double value = caller->run->node_context->progress(caller->child(child));
  slot.access = access;
  return value;
}

static_assert(static_cast<int>(Status::Idle) == LOCKSTEP_IDLE &&
              static_cast<int>(Status::Running) == LOCKSTEP_RUNNING &&
              static_cast<int>(Status::Success) == LOCKSTEP_SUCCESS &&
              static_cast<int>(Status::Failure) == LOCKSTEP_FAILURE &&
              static_cast<int>(Status::Skipped) == LOCKSTEP_SKIPPED);

}  // namespace

const lockstep_children& children_table() {
  static constexpr lockstep_children kTable{.struct_size = sizeof(lockstep_children),
                                            .count = count,
                                            .tick = tick,
                                            .halt = halt,
                                            .pause = pause,
                                            .status = status,
                                            .progress = progress,
                                            .tick_unreset = tick_unreset};
  return kTable;
}

}  // namespace lockstep::host
